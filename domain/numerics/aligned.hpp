#pragma once

#include "domain/numerics/grid.hpp"

#include <cstdlib>
#include <memory>
#include <new>

namespace rough {

/// Memory aligned to a cache line. Loops can use whole vectors, and results do not depend on addresses.
template <typename T>
class AlignedBuffer {
  public:
    /// Memory for `size` elements, uninitialised.
    explicit AlignedBuffer(Index size) : data_(allocate(size)) {}
    /// The first element.
    T* data() { return data_.get(); }
    /// The first element, to read.
    const T* data() const { return data_.get(); }
    /// Element i, 0 <= i < size; unchecked.
    T& operator[](Index i) { return data_.get()[i]; }

  private:
    struct Free {
        void operator()(T* p) const { std::free(p); }
    };
    static T* allocate(Index size) {
        constexpr std::size_t line = 64;
        const std::size_t bytes = (sizeof(T) * static_cast<std::size_t>(size) + line - 1) / line * line;
        void* memory = std::aligned_alloc(line, bytes);
        if (!memory) throw std::bad_alloc();
        return static_cast<T*>(memory);
    }
    std::unique_ptr<T, Free> data_;
};

} // namespace rough
