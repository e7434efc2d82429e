#pragma once

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/object.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Reads a JSON config and hands its objects on: spheres one by one as soon as each is closed, then
/// the camera, the background and the render settings. All mistakes of the text are reported in one
/// run; what could only follow from a mistake is not. A sphere with a mistake is not handed on. The
/// other objects are, with the wrong values left out, unless the text could not be read to its end.
void read_config(const SourceFile& file, ObjectSink& objects, DiagnosticSink& sink);

/// The same, but hands on the spheres only, and requires nothing else to be there.
void read_spheres(const SourceFile& file, ObjectSink& objects, DiagnosticSink& sink);

}  // namespace sdlc::lang
