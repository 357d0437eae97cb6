/// A kernel with its arguments, ready to launch.
#pragma once

#include "host/cl/buffer.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>

namespace macula::compute {

struct KernelState;

/// Work-items in each dimension.
struct Range {
    std::size_t x = 1, y = 1, z = 1;

    /// The least multiple of `local` that covers `count`.
    static constexpr std::size_t cover(std::size_t count, std::size_t local) {
        return (count + local - 1) / local * local;
    }
};

/// An argument in local memory: `bytes` for each work-group.
struct LocalMemory {
    std::size_t bytes;
};

/// A shared handle; arguments belong to what it names. Library::kernel() makes a fresh one on each
/// call. Buffers stay alive while they are an argument.
class Kernel {
  public:
    Kernel() = default;
    explicit Kernel(std::shared_ptr<KernelState> state);

    explicit operator bool() const { return state_ != nullptr; }

    /// All arguments in the kernel's order: Buffer, LocalMemory, or a trivially copyable value of
    /// the parameter's size. Throws Error that names kernel, position and sizes.
    template <class... Arguments>
    Kernel& set(const Arguments&... arguments) {
        begin(sizeof...(arguments));
        std::size_t position = 0;
        (set_one(position++, arguments), ...);
        return *this;
    }
    /// Replaces one argument of an earlier set().
    template <class Argument>
    Kernel& set_at(std::size_t position, const Argument& argument) {
        set_one(position, argument);
        return *this;
    }

    /// Puts the kernel in the queue and a span named `stage` on the device's timeline. `global`
    /// must be a multiple of `local`; an empty global range launches nothing.
    void launch(const std::string& stage, Range global, Range local) const;
    /// The same with a work-group size of the driver's choice.
    void launch(const std::string& stage, Range global) const;

    /// The largest work-group this kernel can have on its device.
    std::size_t max_work_group_size() const;
    /// A good work-group is a multiple of this.
    std::size_t preferred_multiple() const;
    const std::string& name() const;

  private:
    void begin(std::size_t arguments);
    void set_one(std::size_t position, const Buffer& buffer);
    void set_one(std::size_t position, LocalMemory local);
    template <class T>
    void set_one(std::size_t position, const T& value) {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> &&
                      !std::is_same_v<T, bool>);
        set_bytes(position, &value, sizeof(T));
    }
    void set_bytes(std::size_t position, const void* value, std::size_t bytes);

    std::shared_ptr<KernelState> state_;
};

} // namespace macula::compute
