#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <vector>

namespace docent {

/// Memory that begins with a line of the cache, so that no whole vector crosses two.
template <class T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::size_t kLine = 64;
  static constexpr std::size_t kPage = std::size_t{2} << 20U;
  static constexpr std::size_t kLarge = 2 * kPage;
  static constexpr std::align_val_t alignment(std::size_t size) {
    return std::align_val_t{size >= kLarge ? kPage : kLine};
  }

  LineAllocator() = default;
  template <class U>
  explicit LineAllocator(const LineAllocator<U>&) {}
  [[nodiscard]] T* allocate(std::size_t count) {
    const std::size_t size = count * sizeof(T);
    T* const memory = static_cast<T*>(::operator new(size, alignment(size)));
    // A pass over a large array touches a new page every few hundred states: ask for large ones. Advice only.
    if (size >= kLarge) static_cast<void>(::madvise(memory, size, MADV_HUGEPAGE));
    return memory;
  }
  void deallocate(T* memory, std::size_t count) { ::operator delete(memory, alignment(count * sizeof(T))); }
  friend bool operator==(const LineAllocator&, const LineAllocator&) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, LineAllocator<T>>;

}  // namespace docent
