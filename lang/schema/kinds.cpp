#include <array>

#include "lang/schema/schema.hpp"
#include "render/image/tone.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::lang {
namespace {

using Text = std::string_view;
using Words = std::span<const std::string_view>;

constexpr std::array<Text, 3> kPrecisionWords{"auto", render::kWords<render::Precision>.front(),
                                              render::kWords<render::Precision>.back()};
constexpr std::array<Text, 2> kFresnelWords{"schlick", "exact"};

// A row of a table: `required` and `optional` have no default, `defaulted` has one with its
// spelling in the language, and `choice` has one of its words.

constexpr Property required(Text name, Type type, Range range, Text doc) {
  return {.name = name, .type = type, .range = range, .presence = Presence::Required, .doc = doc};
}
constexpr Property optional(Text name, Type type, Range range, Text doc) {
  return {.name = name, .type = type, .range = range, .doc = doc};
}
constexpr Property defaulted(Text name, Type type, Range range, Default value, Text spelling,
                             Text doc) {
  return {.name = name,
          .type = type,
          .range = range,
          .default_value = value,
          .default_text = spelling,
          .doc = doc};
}
constexpr Property choice(Text name, Words words, Text usual, Text doc) {
  Property property = defaulted(name, Type::Word, Range::Any, usual, usual, doc);
  property.words = words;
  return property;
}

constexpr auto kCameraProperties = std::to_array<Property>({
    required("from", Type::Vec3, Range::Any, "The position of the camera."),
    required("at", Type::Vec3, Range::Any, "The point in the middle of the picture."),
    defaulted("up", Type::Vec3, Range::Any, std::array{0.0, 1.0, 0.0}, "(0, 1, 0)",
              "The direction that points up in the picture; of any length but 0, and not along the"
              " view."),
    required("fov", Type::Angle, Range::BetweenZeroAndHalfTurn,
             "The vertical angle of view, from the bottom of the picture to its top."),
    defaulted("view_height", Type::Number, Range::Positive, 2.0, "2",
              "The view plane at distance 1 is `view_height * tan(fov / 2)` high; at 2, `fov` is "
              "the angle of view."),
    defaulted("aspect", Type::Number, Range::Positive, 16.0 / 9.0, "16 / 9",
              "Width of the picture divided by its height."),
    {.name = "shutter",
     .type = Type::Interval,
     .default_text = "none",
     .reads_none = true,
     .doc = "The times at which the shutter opens and closes, relative to the frame's `time`; "
            "`none`: nothing moves."},
    defaulted("aperture", Type::Length, Range::NonNegative, 0.0, "0",
              "Diameter of the lens, in metres; 0: a pinhole, with everything in focus."),
    optional("focus", Type::Focus, Range::Positive,
             "What is in focus: a distance along the view axis, a point, or the name of a sphere; "
             "default: the distance of `at`."),
});
static_assert(kCameraProperties.size() == camera_property::kCount);

constexpr auto kBackgroundProperties = std::to_array<Property>({
    optional("color", Type::Color, Range::NonNegative, "The same radiance from all directions."),
    optional("bottom", Type::Color, Range::NonNegative,
             "Radiance from straight below; between it and `top`, linear in the height of the "
             "direction."),
    optional("top", Type::Color, Range::NonNegative, "Radiance from straight above."),
});
static_assert(kBackgroundProperties.size() == background_property::kCount);

constexpr auto kSphereProperties = std::to_array<Property>({
    required("center", Type::Vec3, Range::Any, "Position of the centre, in metres."),
    required("radius", Type::Length, Range::NonNegative,
             "From the centre to the surface, in metres; a sphere of radius 0 is invisible."),
    optional("material", Type::Material, Range::Any,
             "How the surface scatters light; default: the material of the nearest enclosing group"
             " that has one."),
    optional("motion", Type::Motion, Range::Any,
             "`line(…)`: how the centre moves while the shutter is open."),
});
static_assert(kSphereProperties.size() == sphere_property::kCount);

constexpr auto kRenderProperties = std::to_array<Property>({
    defaulted("width", Type::WholeNumber, Range::AtLeastOne, 960.0, "960",
              "Width of the picture in pixels."),
    optional("height", Type::WholeNumber, Range::AtLeastOne,
             "Height of the picture in pixels; default: width / aspect, rounded down."),
    defaulted("samples", Type::WholeNumber, Range::AtLeastOne, 64.0, "64",
              "Paths per pixel; four times as many halve the noise. With `error`: the maximum."),
    defaulted("depth", Type::WholeNumber, Range::AtLeastOne, 16.0, "16",
              "Rays per path, including the camera's; a path that reaches the limit is black."),
    optional("output", Type::String, Range::Any,
             "The picture's file; the extension selects the format."),
    choice("tone", render::kToneWords, "srgb",
           "Tone curve of png, jpg and other 8-bit pictures; exr and hdr stay linear. neutral: "
           "compresses highlights and keeps their hue."),
    defaulted("exposure", Type::Number, Range::Any, 0.0, "0",
              "Brightness of 8-bit pictures in stops: radiance is multiplied by 2^exposure before "
              "the tone curve."),
    optional("camera", Type::Word, Range::Any, "Which camera to use, if there are several."),
    defaulted("seed", Type::WholeNumber, Range::NonNegativeExact, 0.0, "0",
              "Seed of the random numbers: another seed gives other noise."),
    defaulted("threads", Type::WholeNumber, Range::NonNegative, 0.0, "0",
              "Number of threads; 0: all of the machine. Does not change the picture."),
    choice("precision", kPrecisionWords, "auto",
           "Precision of ray tracing; auto: `float` if its rounding is invisible, else `double`. "
           "In `float`, a few large spheres may be intersected in double."),
    choice("sampler", render::kWords<render::SamplerKind>, "sobol",
           "Source of the random numbers; sobol: a low-discrepancy sequence, with less noise"
           " for as many samples; independent: independent numbers."),
    choice("light_sampling", render::kWords<render::LightSampling>, "auto",
           "Whether diffuse surfaces and rough metal sample lights directly, which reduces noise"
           " where lights are small; caustics: also by way of smooth mirrors and glass; auto: what"
           " pays. Changes the noise only."),
    optional("error", Type::Number, Range::PositiveFraction,
             "The relative error of the picture to reach, such as `1%`: the root mean square of the"
             " linear error over pixels and channels, divided by the mean linear radiance."),
});
static_assert(kRenderProperties.size() == render_property::kCount);

constexpr auto kGroupProperties = std::to_array<Property>({
    defaulted("translate", Type::Vec3, Range::Any, std::array{0.0, 0.0, 0.0}, "(0, 0, 0)",
              "Moves the contents, after scale and rotation."),
    {.name = "rotate",
     .type = Type::Angles,
     .default_text = "(0deg, 0deg, 0deg)",
     .doc = "Rotates the contents about the x, then the y, then the z axis; counterclockwise, "
            "seen from the tip of the axis."},
    defaulted("scale", Type::Number, Range::Positive, 1.0, "1",
              "Factor of all distances and radii inside."),
    optional("material", Type::Material, Range::Any,
             "For the spheres inside that have none of their own; the innermost group wins."),
});
static_assert(kGroupProperties.size() == group_property::kCount);

constexpr auto kAnimationProperties = std::to_array<Property>({
    required("frames", Type::Frames, Range::Any,
             "The numbers of the first and the last frame, whole and from 0 on."),
    defaulted("fps", Type::Number, Range::Positive, 24.0, "24",
              "Frames per second: `time` is frame / fps."),
    defaulted("step", Type::WholeNumber, Range::AtLeastOne, 1.0, "1",
              "2 renders every other frame."),
});
static_assert(kAnimationProperties.size() == animation_property::kCount);

constexpr auto kKinds = std::to_array<Kind>({
    {.id = ObjectKind::Camera,
     .name = "camera",
     .takes_name = true,
     .is_setting = true,
     .properties = kCameraProperties,
     .doc = "The camera of the picture."},
    {.id = ObjectKind::Background,
     .name = "background",
     .is_unique = true,
     .is_setting = true,
     .properties = kBackgroundProperties,
     .doc = "The light of rays that hit no sphere."},
    {.id = ObjectKind::Sphere,
     .name = "sphere",
     .takes_name = true,
     .properties = kSphereProperties,
     .doc = "A sphere."},
    {.id = ObjectKind::Render,
     .name = "render",
     .is_unique = true,
     .is_setting = true,
     .properties = kRenderProperties,
     .doc = "Settings of the renderer; each has a flag of the same name."},
    {.id = ObjectKind::Group,
     .name = "group",
     .takes_name = true,
     .properties = kGroupProperties,
     .doc = "Objects that are moved, rotated, scaled and coloured together."},
    {.id = ObjectKind::Animation,
     .name = "animation",
     .is_unique = true,
     .is_setting = true,
     .properties = kAnimationProperties,
     .doc = "The frames of a film."},
});

constexpr Text kReflected = "The fraction of the light that is reflected.";
constexpr auto kDiffuseArguments =
    std::to_array<Property>({required("color", Type::Color, Range::NonNegative, kReflected)});
constexpr auto kSpecularArguments = std::to_array<Property>({
    required("color", Type::Color, Range::NonNegative, kReflected),
    defaulted("fuzz", Type::Number, Range::NonNegative, 0.0, "0",
              "Blurs the mirror: radius of the sphere around the tip of the mirrored direction, in"
              " which the reflected direction ends. 0 is sharp."),
});
constexpr auto kTransmissiveArguments = std::to_array<Property>({
    defaulted("color", Type::Color, Range::NonNegative, std::array{1.0, 1.0, 1.0}, "white",
              "The fraction of the light that is reflected or transmitted."),
    required("ior", Type::Number, Range::Positive,
             "Index of refraction inside divided by that outside: 1.5 for glass in air."),
    choice(
        "fresnel", kFresnelWords, "schlick",
        "How the reflectance is computed: by Schlick's approximation or by Fresnel's equations."),
});
constexpr auto kEmissiveArguments = std::to_array<Property>({
    required("color", Type::Color, Range::NonNegative, "Colour of the light."),
    defaulted("intensity", Type::Number, Range::NonNegative, 1.0, "1",
              "The radiance is `color * intensity`."),
});
constexpr auto kUnlitArguments = std::to_array<Property>(
    {required("color", Type::Color, Range::NonNegative, "The visible colour.")});

constexpr auto kMaterials = std::to_array<MaterialInfo>({
    {MaterialKind::Diffuse, "diffuse", "diffuse", kDiffuseArguments,
     "Matt: scatters by the cosine law."},
    {MaterialKind::Specular, "specular", "specular", kSpecularArguments,
     "A mirror, sharp or blurred: metals."},
    {MaterialKind::Transmissive, "transmissive", "transmissive", kTransmissiveArguments,
     "Glass, water: reflects and refracts."},
    {MaterialKind::Emissive, "emissive", "emissive", kEmissiveArguments,
     "A light; paths end here."},
    {MaterialKind::Unlit, "unlit", "no_texture", kUnlitArguments,
     "A colour that does not depend on light; paths end here."},
});

}  // namespace

std::span<const Kind> all_kinds() noexcept { return kKinds; }
const Kind& kind_info(ObjectKind kind) noexcept { return kKinds[static_cast<std::size_t>(kind)]; }

std::span<const MaterialInfo> all_materials() noexcept { return kMaterials; }
const MaterialInfo& material_info(MaterialKind kind) noexcept {
  return kMaterials[static_cast<std::size_t>(kind)];
}

}  // namespace sdlc::lang
