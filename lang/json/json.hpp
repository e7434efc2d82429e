#pragma once

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/object.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Reads a JSON config and passes its objects to `objects`: each sphere as soon as it is closed,
/// then the camera, the background and the render settings. Reports all mistakes, except those that
/// may only follow from another one. A sphere with a mistake is dropped. The other objects are
/// passed on without their wrong values, unless the parse stopped before the end.
void read_config(const SourceFile& file, ObjectSink& objects, DiagnosticSink& sink);

/// Reads only the spheres of a JSON config, which may have nothing else.
void read_spheres(const SourceFile& file, ObjectSink& objects, DiagnosticSink& sink);

}  // namespace sdlc::lang
