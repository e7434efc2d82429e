#include <array>

#include "lang/schema/schema.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::lang {
namespace {

constexpr std::array<std::string_view, 3> kToneWords{"srgb", "sqrt", "linear"};
constexpr std::array<std::string_view, 3> kPrecisionWords{"auto", "float", "double"};
constexpr std::array<std::string_view, 2> kFresnelWords{"schlick", "exact"};

constexpr auto kCameraProperties = std::to_array<Property>({
    {.name = "from",
     .type = Type::Vec3,
     .presence = Presence::Required,
     .doc = "Where the camera stands."},
    {.name = "at",
     .type = Type::Vec3,
     .presence = Presence::Required,
     .doc = "The point in the middle of the picture."},
    {.name = "up",
     .type = Type::Vec3,
     .default_value = std::array{0.0, 1.0, 0.0},
     .default_text = "(0, 1, 0)",
     .doc = "The direction that points up in the picture; of any length but 0, and not along the"
            " view."},
    {.name = "fov",
     .type = Type::Angle,
     .range = Range::BetweenZeroAndHalfTurn,
     .presence = Presence::Required,
     .doc = "The angle seen, from the bottom of the picture to its top."},
    {.name = "view_height",
     .type = Type::Number,
     .range = Range::Positive,
     .default_value = 2.0,
     .default_text = "2",
     .doc = "The view plane at distance 1 is `view_height * tan(fov / 2)` high; at 2, `fov` is "
            "the angle seen."},
    {.name = "aspect",
     .type = Type::Number,
     .range = Range::Positive,
     .default_value = 16.0 / 9.0,
     .default_text = "16 / 9",
     .doc = "Width of the picture over its height."},
    {.name = "shutter",
     .type = Type::Interval,
     .default_text = "none",
     .reads_none = true,
     .doc = "From when to when the shutter is open, counted from the frame's `time`; `none`: "
            "everything stands still."},
});
static_assert(kCameraProperties.size() == camera_property::kCount);

constexpr auto kBackgroundProperties = std::to_array<Property>({
    {.name = "color",
     .type = Type::Color,
     .range = Range::NonNegative,
     .doc = "The same radiance from everywhere."},
    {.name = "bottom",
     .type = Type::Color,
     .range = Range::NonNegative,
     .doc = "Radiance from straight below; between it and `top`, linear in the height of the "
            "direction."},
    {.name = "top",
     .type = Type::Color,
     .range = Range::NonNegative,
     .doc = "Radiance from straight above."},
});
static_assert(kBackgroundProperties.size() == background_property::kCount);

constexpr auto kSphereProperties = std::to_array<Property>({
    {.name = "center",
     .type = Type::Vec3,
     .presence = Presence::Required,
     .doc = "Where its middle is, in metres."},
    {.name = "radius",
     .type = Type::Length,
     .range = Range::NonNegative,
     .presence = Presence::Required,
     .doc = "From the middle to the surface, in metres; a sphere of radius 0 is never seen."},
    {.name = "material",
     .type = Type::Material,
     .doc = "What light does at the surface; by default the material of the nearest group around"
            " it that has one."},
    {.name = "motion",
     .type = Type::Motion,
     .doc = "`line(…)`: how the centre moves while the shutter is open."},
});
static_assert(kSphereProperties.size() == sphere_property::kCount);

constexpr auto kRenderProperties = std::to_array<Property>({
    {.name = "width",
     .type = Type::WholeNumber,
     .range = Range::AtLeastOne,
     .default_value = 960.0,
     .default_text = "960",
     .doc = "Width of the picture in pixels."},
    {.name = "height",
     .type = Type::WholeNumber,
     .range = Range::AtLeastOne,
     .doc = "Height of the picture in pixels; by default its width over its aspect, rounded "
            "down."},
    {.name = "samples",
     .type = Type::WholeNumber,
     .range = Range::AtLeastOne,
     .default_value = 64.0,
     .default_text = "64",
     .doc = "Paths per pixel; four times as many halve the noise. Beside an `error`: the most of "
            "them."},
    {.name = "depth",
     .type = Type::WholeNumber,
     .range = Range::AtLeastOne,
     .default_value = 16.0,
     .default_text = "16",
     .doc = "Rays per path, the camera's included; a path cut off by it is black."},
    {.name = "output",
     .type = Type::String,
     .doc = "The picture's file; the extension picks the format."},
    {.name = "tone",
     .type = Type::Word,
     .default_value = std::string_view("srgb"),
     .default_text = "srgb",
     .words = kToneWords,
     .doc = "How light becomes the codes of png, jpg and other 8-bit pictures; exr and hdr stay "
            "linear."},
    {.name = "camera", .type = Type::Word, .doc = "Which camera, where there are several."},
    {.name = "seed",
     .type = Type::WholeNumber,
     .range = Range::NonNegativeExact,
     .default_value = 0.0,
     .default_text = "0",
     .doc = "Picks the random numbers: another seed, other noise."},
    {.name = "threads",
     .type = Type::WholeNumber,
     .range = Range::NonNegative,
     .default_value = 0.0,
     .default_text = "0",
     .doc = "Threads that render; 0: all of the machine. Never changes the picture."},
    {.name = "precision",
     .type = Type::Word,
     .default_value = std::string_view("auto"),
     .default_text = "auto",
     .words = kPrecisionWords,
     .doc = "Of the numbers that paths are computed in; auto: `float` where nothing can be seen of "
            "its rounding, else `double`. In `float` a few large spheres may be met in double."},
    {.name = "sampler",
     .type = Type::Word,
     .default_value = std::string_view("sobol"),
     .default_text = "sobol",
     .words = render::kWords<render::SamplerKind>,
     .doc = "Where random numbers come from; sobol: points that fill space evenly, with less noise"
            " for as many samples; independent: each number by itself."},
    {.name = "light_sampling",
     .type = Type::Word,
     .default_value = std::string_view("auto"),
     .default_text = "auto",
     .words = render::kWords<render::LightSampling>,
     .doc = "Whether matt surfaces look for lamps by themselves, with less noise where these are"
            " small; auto: where it pays. Never changes what is drawn but for its noise."},
    {.name = "error",
     .type = Type::Number,
     .range = Range::PositiveFraction,
     .doc = "The relative error of the picture to reach, such as `1%`: the root mean square of the"
            " linear error over pixels and channels, divided by the mean linear radiance."},
});
static_assert(kRenderProperties.size() == render_property::kCount);

constexpr auto kGroupProperties = std::to_array<Property>({
    {.name = "translate",
     .type = Type::Vec3,
     .default_value = std::array{0.0, 0.0, 0.0},
     .default_text = "(0, 0, 0)",
     .doc = "Moves what is inside, after it was scaled and rotated."},
    {.name = "rotate",
     .type = Type::Angles,
     .default_text = "(0deg, 0deg, 0deg)",
     .doc = "Turns what is inside about the x, then the y, then the z axis; counterclockwise, "
            "seen from the tip of the axis."},
    {.name = "scale",
     .type = Type::Number,
     .range = Range::Positive,
     .default_value = 1.0,
     .default_text = "1",
     .doc = "Factor of all distances and radii inside."},
    {.name = "material",
     .type = Type::Material,
     .doc = "Of the spheres inside that have none of their own; the nearest group's counts."},
});
static_assert(kGroupProperties.size() == group_property::kCount);

constexpr auto kAnimationProperties = std::to_array<Property>({
    {.name = "frames",
     .type = Type::Frames,
     .presence = Presence::Required,
     .doc = "The numbers of the first and the last frame, whole and from 0 on."},
    {.name = "fps",
     .type = Type::Number,
     .range = Range::Positive,
     .default_value = 24.0,
     .default_text = "24",
     .doc = "Frames in a second: `time` is frame / fps."},
    {.name = "step",
     .type = Type::WholeNumber,
     .range = Range::AtLeastOne,
     .default_value = 1.0,
     .default_text = "1",
     .doc = "2 renders every other frame."},
});
static_assert(kAnimationProperties.size() == animation_property::kCount);

constexpr auto kKinds = std::to_array<Kind>({
    {.id = ObjectKind::Camera,
     .name = "camera",
     .takes_name = true,
     .is_unique = false,
     .is_setting = true,
     .properties = kCameraProperties,
     .doc = "Where the picture is taken from."},
    {.id = ObjectKind::Background,
     .name = "background",
     .takes_name = false,
     .is_unique = true,
     .is_setting = true,
     .properties = kBackgroundProperties,
     .doc = "What is seen where there is no sphere."},
    {.id = ObjectKind::Sphere,
     .name = "sphere",
     .takes_name = true,
     .is_unique = false,
     .is_setting = false,
     .properties = kSphereProperties,
     .doc = "A sphere."},
    {.id = ObjectKind::Render,
     .name = "render",
     .takes_name = false,
     .is_unique = true,
     .is_setting = true,
     .properties = kRenderProperties,
     .doc = "How the picture is made; every setting has a flag of the same name."},
    {.id = ObjectKind::Group,
     .name = "group",
     .takes_name = true,
     .is_unique = false,
     .is_setting = false,
     .properties = kGroupProperties,
     .doc = "Objects that are moved, turned, scaled and coloured together."},
    {.id = ObjectKind::Animation,
     .name = "animation",
     .takes_name = false,
     .is_unique = true,
     .is_setting = true,
     .properties = kAnimationProperties,
     .doc = "The frames of a film."},
});

constexpr Property kColor{.name = "color",
                          .type = Type::Color,
                          .range = Range::NonNegative,
                          .presence = Presence::Required,
                          .doc = "The part of the light that goes on."};

constexpr auto kDiffuseArguments = std::to_array<Property>({kColor});
constexpr auto kSpecularArguments = std::to_array<Property>({
    kColor,
    {.name = "fuzz",
     .type = Type::Number,
     .range = Range::NonNegative,
     .default_value = 0.0,
     .default_text = "0",
     .doc = "Blurs the mirror: the direction ends in a ball of this radius around the tip of the"
            " mirrored one. 0 is sharp."},
});
constexpr auto kTransmissiveArguments = std::to_array<Property>({
    {.name = "color",
     .type = Type::Color,
     .range = Range::NonNegative,
     .default_value = std::array{1.0, 1.0, 1.0},
     .default_text = "white",
     .doc = "The part of the light that goes on."},
    {.name = "ior",
     .type = Type::Number,
     .range = Range::Positive,
     .presence = Presence::Required,
     .doc = "Index of refraction inside over that outside: 1.5 for glass in air."},
    {.name = "fresnel",
     .type = Type::Word,
     .default_value = std::string_view("schlick"),
     .default_text = "schlick",
     .words = kFresnelWords,
     .doc = "How the share of reflected light is computed: by Schlick's approximation or "
            "Fresnel's equations."},
});
constexpr auto kEmissiveArguments = std::to_array<Property>({
    {.name = "color",
     .type = Type::Color,
     .range = Range::NonNegative,
     .presence = Presence::Required,
     .doc = "Colour of the light."},
    {.name = "intensity",
     .type = Type::Number,
     .range = Range::NonNegative,
     .default_value = 1.0,
     .default_text = "1",
     .doc = "The radiance is `color * intensity`."},
});
constexpr auto kUnlitArguments = std::to_array<Property>({
    {.name = "color",
     .type = Type::Color,
     .range = Range::NonNegative,
     .presence = Presence::Required,
     .doc = "What is seen."},
});

constexpr auto kMaterials = std::to_array<MaterialInfo>({
    {.id = MaterialKind::Diffuse,
     .name = "diffuse",
     .json_name = "diffuse",
     .arguments = kDiffuseArguments,
     .doc = "Matt: scatters by the cosine law."},
    {.id = MaterialKind::Specular,
     .name = "specular",
     .json_name = "specular",
     .arguments = kSpecularArguments,
     .doc = "A mirror, sharp or blurred: metals."},
    {.id = MaterialKind::Transmissive,
     .name = "transmissive",
     .json_name = "transmissive",
     .arguments = kTransmissiveArguments,
     .doc = "Glass, water: reflects and refracts."},
    {.id = MaterialKind::Emissive,
     .name = "emissive",
     .json_name = "emissive",
     .arguments = kEmissiveArguments,
     .doc = "A light; paths end here."},
    {.id = MaterialKind::Unlit,
     .name = "unlit",
     .json_name = "no_texture",
     .arguments = kUnlitArguments,
     .doc = "A colour that is seen as it is, whatever the light; paths end here."},
});

}  // namespace

std::span<const Kind> all_kinds() noexcept { return kKinds; }
const Kind& kind_info(ObjectKind kind) noexcept { return kKinds[static_cast<std::size_t>(kind)]; }

std::span<const MaterialInfo> all_materials() noexcept { return kMaterials; }
const MaterialInfo& material_info(MaterialKind kind) noexcept {
  return kMaterials[static_cast<std::size_t>(kind)];
}

}  // namespace sdlc::lang
