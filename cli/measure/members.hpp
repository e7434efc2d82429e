#pragma once

#include <tuple>

#include "cli/report/member.hpp"
#include "cli/report/point_columns.hpp"
#include "render/measure/measurement.hpp"

/// Declarations of structs that are both in reports and in work folders.
namespace sdlc::cli {

template <>
inline constexpr auto kMembers<render::Configuration> = std::apply(
    [](const auto&... settings) {
      return std::tuple{Member(settings.name, settings.member, Range{1})...};
    },
    render::kConfigurationSettings);

template <>
inline constexpr std::tuple kMembers<render::Reference>{
    Member("", &render::Reference::configuration),
    Member("samples", &render::Reference::samples, kSamplesRange),
    Member("seed", &render::Reference::seed),
    Member("seconds", &render::Reference::seconds),
    Member("relative_error", &render::Reference::error),
    Member("mean_radiance", &render::Reference::mean_radiance),
    Member("scarce_emitters", &render::Reference::scarce_emitters)};

}  // namespace sdlc::cli
