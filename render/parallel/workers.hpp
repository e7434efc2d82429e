#pragma once

#include <memory>

namespace sdlc::render {

class Pool;

/// The threads of one render.
class Workers {
 public:
  /// `threads` as in RenderSettings. They start with the first loop; fewer if the system refuses.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// With the thread that calls run().
  int count() const noexcept;

  /// Calls `work`, whose parallel loops use these threads.
  template <typename Work>
  decltype(auto) run(const Work& work) const {
    const InUse in_use(pool_.get());
    return work();
  }

 private:
  /// Makes the pool that of the calling thread.
  class InUse {
   public:
    explicit InUse(Pool* pool) noexcept;
    ~InUse();
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;

   private:
    Pool* before_;
  };

  std::unique_ptr<Pool> pool_;
};

}  // namespace sdlc::render
