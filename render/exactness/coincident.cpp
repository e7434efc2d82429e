#include "render/exactness/coincident.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "render/exactness/suspects.hpp"

namespace sdlc::render {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// Finds clusters by recursive splitting: sorts the spheres by one coordinate after another, and
/// cuts wherever neighbours are further apart than the tolerance. Spheres that no coordinate
/// separates are compared pairwise.
class CoincidenceSearch {
 public:
  CoincidenceSearch(const std::vector<Sphere>& spheres, const std::vector<Vec3>& shifts)
      : spheres_(spheres), shifts_(shifts) {}

  std::vector<CoincidentSphere> run() {
    std::vector<std::uint32_t> suspects = find_suspects(spheres_);
    split(suspects, 0, 0);
    std::sort(found_.begin(), found_.end(),
              [](const auto& a, const auto& b) { return a.sphere < b.sphere; });
    return std::move(found_);
  }

 private:
  // Radius, centre, and the shift if there is motion.
  int coordinates() const { return shifts_.empty() ? 4 : 7; }

  double coordinate(std::uint32_t i, int k) const {
    const Sphere& s = spheres_[i];
    switch (k) {
      case 0: return s.radius;
      case 1: return s.center.x;
      case 2: return s.center.y;
      case 3: return s.center.z;
      case 4: return shifts_[i].x;
      case 5: return shifts_[i].y;
      default: return shifts_[i].z;
    }
  }

  bool within_tolerance(std::uint32_t a, std::uint32_t b) const {
    for (int k = 0; k < coordinates(); ++k) {
      if (std::fabs(coordinate(a, k) - coordinate(b, k)) >
          kCoincidenceTolerance * spheres_[a].radius) {
        return false;
      }
    }
    return true;
  }

  bool equal(std::uint32_t a, std::uint32_t b) const {
    for (int k = 0; k < coordinates(); ++k) {
      if (coordinate(a, k) != coordinate(b, k)) return false;
    }
    return true;
  }

  /// `tried`: the number of successive coordinates that did not cut this cluster.
  void split(std::span<std::uint32_t> cluster, int k, int tried) {
    while (cluster.size() > 1 && tried < coordinates()) {
      std::sort(cluster.begin(), cluster.end(), [&](std::uint32_t a, std::uint32_t b) {
        return coordinate(a, k) < coordinate(b, k);
      });
      double radius = 0;
      for (const std::uint32_t i : cluster) radius = std::max(radius, spheres_[i].radius);
      const int next = (k + 1) % coordinates();
      std::size_t begin = 0;
      for (std::size_t i = 1; i < cluster.size(); ++i) {
        const double gap = coordinate(cluster[i], k) - coordinate(cluster[i - 1], k);
        // Radii are the first coordinate, so that a cluster has similar radii before the other
        // coordinates are cut; until then each pair has its own tolerance.
        const double size = k == 0 ? spheres_[cluster[i]].radius : radius;
        if (gap <= kCoincidenceTolerance * size) continue;
        split(cluster.subspan(begin, i - begin), next, 1);
        begin = i;
      }
      if (begin > 0) {
        split(cluster.subspan(begin), next, 1);
        return;
      }
      ++tried;
      k = next;
    }
    if (cluster.size() > 1) compare(cluster);
  }

  /// Compares each sphere of a cluster with the kept ones nearby, in scene order.
  void compare(std::span<std::uint32_t> cluster) {
    std::sort(cluster.begin(), cluster.end());
    const int axis = widest_coordinate(cluster);
    std::multimap<double, std::uint32_t> kept;
    for (const std::uint32_t i : cluster) {
      const double place = coordinate(i, axis);
      const double reach = 2 * kCoincidenceTolerance * spheres_[i].radius;
      std::uint32_t earliest = kNone;
      for (auto k = kept.lower_bound(place - reach); k != kept.end() && k->first <= place + reach;
           ++k) {
        if (within_tolerance(k->second, i)) earliest = std::min(earliest, k->second);
      }
      if (earliest == kNone) {
        kept.emplace(place, i);
      } else {
        found_.push_back({.sphere = i, .earlier = earliest, .is_exact = equal(earliest, i)});
      }
    }
  }

  /// The coordinate with the widest range: along it the fewest spheres are within reach of each
  /// other.
  int widest_coordinate(std::span<const std::uint32_t> cluster) const {
    int widest = 0;
    double width = -1;
    for (int k = 0; k < coordinates(); ++k) {
      const auto [low, high] = std::minmax_element(
          cluster.begin(), cluster.end(),
          [&](std::uint32_t a, std::uint32_t b) { return coordinate(a, k) < coordinate(b, k); });
      if (coordinate(*high, k) - coordinate(*low, k) > width) {
        width = coordinate(*high, k) - coordinate(*low, k);
        widest = k;
      }
    }
    return widest;
  }

  const std::vector<Sphere>& spheres_;
  const std::vector<Vec3>& shifts_;
  std::vector<CoincidentSphere> found_;
};

}  // namespace

std::vector<CoincidentSphere> find_coincident(const std::vector<Sphere>& spheres,
                                              const std::vector<Vec3>& shifts) {
  return CoincidenceSearch(spheres, shifts).run();
}

void remove_coincident(const std::vector<CoincidentSphere>& found, std::vector<Sphere>& spheres,
                       std::vector<Vec3>& shifts) {
  if (found.empty()) return;
  std::size_t kept = 0, next = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (next < found.size() && found[next].sphere == i) {
      ++next;
      continue;
    }
    spheres[kept] = spheres[i];
    if (!shifts.empty()) shifts[kept] = shifts[i];
    ++kept;
  }
  spheres.resize(kept);
  if (!shifts.empty()) shifts.resize(kept);
}

}  // namespace sdlc::render
