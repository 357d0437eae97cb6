#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace macula::bvh {

// Leaves what resize() adds uninitialised: large arrays are first touched by the threads that fill
// them.
template <typename T>
struct UninitialisedAllocator : std::allocator<T> {
    template <typename U>
    struct rebind {
        using other = UninitialisedAllocator<U>;
    };
    template <typename U>
    void construct(U* place) {
        ::new (static_cast<void*>(place)) U;
    }
    template <typename U, typename... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        ::new (static_cast<void*>(place)) U{std::forward<Arguments>(arguments)...};
    }
};
template <typename T>
using Array = std::vector<T, UninitialisedAllocator<T>>;

} // namespace macula::bvh
