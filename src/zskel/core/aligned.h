#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace zskel {

/// Hands out memory that whole SIMD registers can be loaded from. Elements without values are left
/// as the memory is, not filled with zeros.
template <typename T>
struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::align_val_t kAlignment{64};

    CacheLineAllocator() = default;
    template <typename U>
    explicit CacheLineAllocator(const CacheLineAllocator<U>& /*other*/) {}

    T* allocate(std::size_t count) {
        return static_cast<T*>(::operator new(count * sizeof(T), kAlignment));
    }
    template <typename U>
    void construct(U* memory) {
        ::new (static_cast<void*>(memory)) U;
    }
    void deallocate(T* memory, std::size_t /*count*/) { ::operator delete(memory, kAlignment); }

    friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

template <typename T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace zskel
