#include "lang/compile/compile.hpp"

#include <algorithm>
#include <chrono>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "lang/json/json.hpp"
#include "render/exactness/lens_contact.hpp"

namespace sdlc::lang {
namespace {

using Clock = std::chrono::steady_clock;

/// The end of the message "this …".
std::string_view describe(const DroppedSphere& sphere) {
  if (!sphere.is_exact) {
    return sphere.has_other_material
               ? "sphere coincides with an earlier one of another material (within 2^-40 of its "
                 "radius)"
               : "sphere coincides with an earlier one (within 2^-40 of its radius)";
  }
  return sphere.has_other_material
             ? "sphere has the place and size of an earlier one of another material"
             : "sphere is the same as an earlier one";
}

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// Counts spheres as a SceneBuilder does, and records the origins of the wanted ones.
class Tracer final : public ObjectSink {
 public:
  /// `wanted`: numbers of spheres in the order of addition, ascending.
  Tracer(const SourceFile& file, const Limits& limits, std::span<const std::uint64_t> wanted,
         DiagnosticSink& sink)
      : builder_(file, limits, sink), wanted_(wanted), sink_(sink) {}

  void add(const Object& object) override {
    builder_.add(object);
    constexpr std::size_t kMostHeld = 4096;
    if (builder_.held_spheres() >= kMostHeld) builder_.forget_spheres();
    if (next_ == wanted_.size() || count() <= wanted_[next_]) return;
    origins_.push_back({.where = object.where,
                        .material = material_of(object),
                        .name = object.name,
                        .chain = sink_.chain()});
    ++next_;
  }
  void enter(const Object& group) override {
    const bool has_own = group.slot(group_property::kMaterial).is_written;
    materials_.push_back(has_own              ? group.location(group_property::kMaterial)
                         : materials_.empty() ? Location{}
                                              : materials_.back());
    builder_.enter(group);
  }
  void leave() override {
    if (!begun_.empty() && begun_.back().depth == materials_.size()) {
      counts_[begun_.back().contents] = {.spheres = count() - begun_.back().count,
                                         .has_material = has_material()};
      begun_.pop_back();
    }
    materials_.pop_back();
    builder_.leave();
  }

  bool is_full() const override { return builder_.is_full() || next_ == wanted_.size(); }

  // Repeated contents are evaluated only if they contain a wanted sphere.
  bool wants_contents() const override { return true; }
  void begin_contents(std::uint32_t contents) override {
    begun_.push_back({.contents = contents, .depth = materials_.size(), .count = count()});
  }
  bool repeat(const Object& group, std::uint32_t contents) override {
    const auto known = counts_.find(contents);
    if (known == counts_.end()) return false;
    const auto& [spheres, had_material] = known->second;
    // A check omits spheres without a material, so the count depends on it.
    const bool has_own = group.slot(group_property::kMaterial).is_written;
    if ((has_own || has_material()) != had_material) return false;
    if (next_ < wanted_.size() && wanted_[next_] < count() + spheres) return false;
    skipped_ += spheres;
    return true;
  }

  std::vector<Origin> take() { return std::move(origins_); }

 private:
  struct Begun {
    std::uint32_t contents;
    std::size_t depth;    // number of open groups
    std::uint64_t count;  // of spheres before
  };

  struct Contents {
    std::uint64_t spheres = 0;
    bool has_material = false;  // from the group or one around it
  };

  bool has_material() const { return !materials_.empty() && materials_.back().file != nullptr; }
  std::uint64_t count() const { return builder_.sphere_count() + skipped_; }
  Location material_of(const Object& sphere) const {
    const bool has_own = sphere.slot(sphere_property::kMaterial).is_written;
    return has_own || materials_.empty() ? sphere.location(sphere_property::kMaterial)
                                         : materials_.back();
  }

  SceneBuilder builder_;
  std::vector<Location> materials_;  // of the open groups
  std::span<const std::uint64_t> wanted_;
  std::size_t next_ = 0;
  DiagnosticSink& sink_;
  std::vector<Origin> origins_;
  std::vector<Begun> begun_;
  std::unordered_map<std::uint32_t, Contents> counts_;
  std::uint64_t skipped_ = 0;
};

}  // namespace

Compiler::Compiler(const Document& file, const ProgramOptions& options, DiagnosticSink& sink)
    : file_(file), options_(options), sink_(sink) {
  const auto start = Clock::now();
  if (file.format() == SourceFormat::Scene) {
    program_ = std::make_unique<Program>(file, options, sink);
  } else {
    for (const SetOption& set : options.sets) sink.report(diag::unknown_param, {}, set.name);
  }
  times_.parse_seconds = seconds(Clock::now() - start);
}

Compiler::~Compiler() = default;

std::optional<Animation> Compiler::animation() {
  if (program_ && !knows_animation_) {
    animation_ = Evaluation(*program_, {.time_free = &time_free_}, sink_).animation();
    knows_animation_ = true;
  }
  return animation_;
}

std::uint64_t Compiler::read(ObjectSink& objects, DiagnosticSink& sink,
                             std::optional<std::uint64_t> steps) {
  if (!program_) {
    if (check_file_size(file_, options_.limits, sink)) read_config(file_, objects, sink);
    return 0;
  }
  const auto camera = overrides_.word(render_property::kCamera);
  Evaluation evaluation(
      *program_, {.frame = frame_, .camera = camera, .steps = steps, .time_free = &time_free_},
      sink);
  evaluation.run(objects);
  return evaluation.steps();
}

LoweredScene Compiler::build(const Overrides& overrides, std::optional<int> frame,
                             Purpose purpose) {
  overrides_ = overrides;
  frame_ = frame;
  const auto start = Clock::now();
  SceneBuilder builder(file_, options_.limits, sink_, purpose, overrides.instancing);
  read(builder, sink_);
  const auto read = Clock::now();
  LoweredScene lowered = builder.finish(overrides);
  check_output(lowered, purpose);
  dropped_ = builder.dropped();
  instance_runs_ = builder.instance_runs();
  // An error may be the reason why two spheres are equal.
  if (!sink_.has_errors()) {
    report_dropped();
    report_scale(lowered, purpose);
    report_lens(lowered, purpose);
  }
  times_.parse_seconds += seconds(read - start);
  times_.lower_seconds = seconds(Clock::now() - read);
  return lowered;
}

std::optional<LoweredScene> Compiler::lower(const Overrides& overrides, std::optional<int> frame) {
  LoweredScene lowered = build(overrides, frame, Purpose::Picture);
  return sink_.has_errors() ? std::nullopt : std::optional(std::move(lowered));
}

LoweredScene Compiler::lower_partly(const Overrides& overrides, std::optional<int> frame) {
  return build(overrides, frame, Purpose::Picture);
}

void Compiler::check(const std::function<void(const LoweredScene&)>& look) {
  const auto check_frame = [&](std::optional<int> frame) {
    const LoweredScene lowered = build({}, frame, Purpose::Check);
    if (look && !sink_.has_errors()) look(lowered);
  };
  const std::optional<Animation> film = animation();
  check_frame({});
  if (film) {
    const int last = film->first + (film->last - film->first) / film->step * film->step;
    if (last != film->first) check_frame(last);
  }
  publish_dependencies();
}

LoweredScene Compiler::check_view(std::optional<int> frame, std::optional<std::string> camera) {
  Overrides overrides;
  if (camera) overrides.render.emplace_back(render_property::kCamera, std::move(*camera));
  return build(overrides, frame, Purpose::Check);
}

void Compiler::check_output(const LoweredScene& lowered, Purpose purpose) {
  const std::string& output = lowered.output.output;
  if (!options_.is_sandboxed || options_.workspace == nullptr || output.empty()) return;
  if (overrides_.names_output) return;
  // A check does not know the working directory of a render: assume the folder of the text.
  std::filesystem::path path = output;
  if (purpose == Purpose::Check) path = std::filesystem::path(file_.name()).parent_path() / output;
  if (Sandbox(*options_.workspace, file_.name()).resolve(path)) return;
  sink_.report(diag::outside_sandbox, lowered.places.output, output)
      .help("`-o` names another place for the picture");
}

void Compiler::report_dropped() {
  // Larger than any number shown, because many may share a place, which is reported once.
  constexpr std::size_t kMostTraced = 10'000;
  const std::size_t count = std::min(dropped_.size(), kMostTraced);
  std::vector<std::uint32_t> wanted;
  for (std::size_t i = 0; i < count; ++i) {
    wanted.insert(wanted.end(), {dropped_[i].sphere, dropped_[i].earlier});
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  if (wanted.empty()) return;
  const std::vector<Origin> origins = trace_added(wanted);
  const auto origin = [&](std::uint32_t sphere) -> const Origin& {
    const auto found = std::lower_bound(wanted.begin(), wanted.end(), sphere);
    return origins[static_cast<std::size_t>(found - wanted.begin())];
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Origin& dropped = origin(dropped_[i].sphere);
    sink_.report(diag::duplicate_sphere, dropped.where, describe(dropped_[i]))
        .label(origin(dropped_[i].earlier).where, "the earlier one, which is kept")
        .help_if(
            dropped_[i].has_other_material
                ? "of two surfaces in one place neither is in front: make one a little larger, "
                  "or take away the one that is not meant"
                : "")
        .chain(dropped.chain);
  }
}

void Compiler::report_scale(const LoweredScene& lowered, Purpose purpose) {
  std::vector<render::Camera> cameras;
  for (const CheckedCamera& checked : lowered.checked_cameras) cameras.push_back(checked.camera);
  if (purpose == Purpose::Picture && lowered.camera) cameras = {lowered.scene.camera};
  cameras.resize(cameras_to_judge(cameras.size(), lowered.scene.spheres.size()));
  for (const render::Camera& camera : cameras) {
    sink_.stop_if_requested();
    const auto fault = find_scale_fault(lowered.scene, camera, lowered.precision);
    if (fault) return report_fault(*fault, {});
  }
}

void Compiler::report_lens(const LoweredScene& lowered, Purpose purpose) {
  const auto check = [&](const render::Camera& camera, Location aperture) {
    sink_.stop_if_requested();
    const auto contact = render::find_lens_contact(lowered.scene, camera);
    if (!contact) return;
    auto report = sink_.report(diag::lens_meets_surface, aperture);
    if (contact->sphere) report.label(trace(std::span(&*contact->sphere, 1))[0].where, "this one");
    report.help("choose a smaller `aperture`, or move the camera");
  };
  if (purpose == Purpose::Picture) {
    if (lowered.camera) check(lowered.scene.camera, lowered.camera->aperture);
    return;
  }
  const auto& cameras = lowered.checked_cameras;
  const std::size_t count = cameras_to_judge(cameras.size(), lowered.scene.spheres.size());
  for (std::size_t i = 0; i < count; ++i) check(cameras[i].camera, cameras[i].aperture);
}

void Compiler::warn_of_precision(const LoweredScene& lowered, render::Precision taken,
                                 const render::PrecisionBounds& bounds) {
  if (sink_.has_errors()) return;  // an error may be the reason
  const auto fault = find_bounds_fault(bounds, taken);
  if (!fault) return;
  const render::PrecisionClause clause = bounds.deciding();
  if (!told_precision_.insert({taken, clause, bounds[clause].sphere}).second) return;
  // A request for float that was not granted is not the cause.
  const bool is_granted =
      lowered.precision != render::Precision::Float || taken != render::Precision::Double;
  const bool is_to_blame = is_granted && !overrides_.has(render_property::kPrecision);
  report_fault(*fault, is_to_blame ? lowered.places.precision : Location{});
}

void Compiler::report_fault(const PrecisionFault& fault, Location setting) {
  std::vector<std::uint32_t> wanted;
  for (const PrecisionFault::Role& role : fault.roles) wanted.push_back(role.sphere);
  std::ranges::sort(wanted);
  const std::vector<Origin> origins = trace(wanted);
  const auto origin = [&](const PrecisionFault::Role& role) -> const Origin& {
    const auto found = std::ranges::lower_bound(wanted, role.sphere);
    return origins[static_cast<std::size_t>(found - wanted.begin())];
  };
  const bool is_set = setting.file != nullptr;
  Location where{&file_, {0, 0}};
  if (!fault.roles.empty()) where = origin(fault.roles.front()).where;
  auto report = sink_.report_as(*fault.info, is_set ? setting : where, fault.message);
  for (std::size_t i = is_set ? 0 : 1; i < fault.roles.size(); ++i) {
    report.label(origin(fault.roles[i]).where, fault.roles[i].label);
  }
  report.help(fault.help);
  if (!is_set && !fault.roles.empty()) report.chain(origin(fault.roles.front()).chain);
}

std::vector<Origin> Compiler::trace_added(std::span<const std::uint32_t> spheres) {
  std::vector<std::uint64_t> wanted;
  auto run = instance_runs_.begin();
  std::uint64_t of_instances = 0;
  for (const std::uint32_t sphere : spheres) {
    for (; run != instance_runs_.end() && run->before <= sphere; ++run) of_instances += run->count;
    wanted.push_back(sphere + of_instances);
  }
  DiagnosticSink ignored(sink_.stop_request());
  Tracer tracer(file_, options_.limits, wanted, ignored);
  // Limit all traces together to the steps of two evaluations.
  const std::uint64_t most = 2 * std::min(options_.limits.steps, std::uint64_t{1} << 62);
  trace_steps_ += read(tracer, ignored, most - std::min(most, trace_steps_));
  std::vector<Origin> origins = tracer.take();
  // Spheres of instances, and those not found within the limit, have no place.
  origins.resize(spheres.size());
  return origins;
}

std::vector<Origin> Compiler::trace(std::span<const std::uint32_t> spheres) {
  std::vector<std::uint32_t> added;
  auto dropped = dropped_.begin();
  for (const std::uint32_t sphere : spheres) {
    // Each dropped sphere before it has shifted its index by one.
    auto index = static_cast<std::uint32_t>(sphere + (dropped - dropped_.begin()));
    for (; dropped != dropped_.end() && dropped->sphere <= index; ++dropped) ++index;
    added.push_back(index);
  }
  return trace_added(added);
}

void Compiler::read_all_files() {
  if (program_) program_->load_all(sink_);
  publish_dependencies();
}

void Compiler::publish_dependencies() {
  if (options_.workspace == nullptr) return;
  const auto publish = [&](const std::vector<std::filesystem::path>& files) {
    options_.workspace->set_dependencies(file_.name(), files);
  };
  if (!program_) return publish({});
  if (program_->has_loaded_all()) return publish(program_->wanted());
  // Some includes were not reached. Load them into another program: an error in a file is reported
  // only when an evaluation includes it.
  DiagnosticSink ignored(sink_.stop_request());
  Program all(file_, options_, ignored);
  all.load_all(ignored);
  publish(all.wanted());
}

std::vector<std::filesystem::path> Compiler::dependencies() const {
  return program_ ? program_->dependencies() : std::vector<std::filesystem::path>();
}

std::optional<LoweredScene> compile(const Document& file, const Overrides& overrides,
                                    DiagnosticSink& sink) {
  return Compiler(file, {}, sink).lower(overrides);
}

}  // namespace sdlc::lang
