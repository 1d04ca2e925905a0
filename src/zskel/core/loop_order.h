#pragma once

#if defined(__SANITIZE_THREAD__)
extern "C" void __tsan_acquire(void* place);
extern "C" void __tsan_release(void* place);
// For what a library calls: what it has captured is read before the order can be told.
#define ZSKEL_CALLED_BY_LIBRARY __attribute__((no_sanitize_thread))
#else
#define ZSKEL_CALLED_BY_LIBRARY
#endif

namespace zskel {

/// ThreadSanitizer cannot see into TBB's and Embree's libraries. It is told what a parallel loop
/// orders, and no more: the caller before every body, every body before the caller's going on, no
/// body before another. One lives as long as the loop.
class LoopOrder {
  public:
    /// Lives as long as a body, also one that throws.
    class Body {
      public:
        explicit Body(LoopOrder& order) : order_(order) { order_.begin_body(); }
        ~Body() { order_.end_body(); }
        Body(const Body&) = delete;
        Body& operator=(const Body&) = delete;

      private:
        LoopOrder& order_;
    };

#if defined(__SANITIZE_THREAD__)
    LoopOrder() {
        __tsan_release(&fork_);
    }
    ~LoopOrder() {
        join();
    }
    /// All bodies so far come before what follows.
    void join() {
        __tsan_acquire(&join_);
    }

  private:
    void begin_body() {
        __tsan_acquire(&fork_);
    }
    void end_body() {
        __tsan_release(&join_);
    }

    char fork_ = 0;
    char join_ = 0;
#else
    void join() {}

  private:
    void begin_body() {}
    void end_body() {}
#endif
};

}  // namespace zskel
