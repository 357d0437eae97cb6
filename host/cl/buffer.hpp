/// Device memory and its maps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

namespace macula::compute {

struct BufferState;
enum class MapMode { read, write, update };

/// A mapped range of a buffer; unmapped on destruction. While it lives the device must not touch
/// the buffer.
class RawMap {
  public:
    RawMap(std::shared_ptr<BufferState> buffer, MapMode mode, std::uint64_t offset,
           std::uint64_t bytes);
    ~RawMap();
    RawMap(RawMap&& other) noexcept;
    RawMap& operator=(RawMap&& other) noexcept;
    RawMap(const RawMap&) = delete;
    RawMap& operator=(const RawMap&) = delete;

    std::byte* data() const { return data_; }

  private:
    void release() noexcept;

    std::shared_ptr<BufferState> buffer_;
    std::byte* data_ = nullptr;
};

template <class T>
class Mapped : public std::span<T> {
  public:
    Mapped(RawMap map, std::size_t count)
        : std::span<T>(reinterpret_cast<T*>(map.data()), count), map_(std::move(map)) {}

  private:
    RawMap map_;
};

/// A shared handle of a device buffer; default-constructed, none (a null pointer to a kernel).
class Buffer {
  public:
    Buffer() = default;
    explicit Buffer(std::shared_ptr<BufferState> state);

    explicit operator bool() const { return state_ != nullptr; }
    /// Bytes asked for at allocation; 0 for none.
    std::uint64_t size() const;
    /// What the buffer was allocated for.
    const std::string& what() const;

    /// Whole elements of T that fit.
    template <class T>
    std::uint64_t count() const {
        return size() / sizeof(T);
    }

    /// Waits for the launched work, then gives `count` elements from element `first` on (all of the
    /// rest by default). Throws Error when the range leaves the buffer.
    template <class T>
    Mapped<const T> map_read(std::uint64_t first = 0, std::uint64_t count = kRest) const {
        return map<const T>(MapMode::read, first, count);
    }
    /// For writing every element of the range; what it held is lost.
    template <class T>
    Mapped<T> map_write(std::uint64_t first = 0, std::uint64_t count = kRest) {
        return map<T>(MapMode::write, first, count);
    }
    /// For reading and writing.
    template <class T>
    Mapped<T> map_update(std::uint64_t first = 0, std::uint64_t count = kRest) {
        return map<T>(MapMode::update, first, count);
    }

    /// One element, e.g. a count that the device computed. Waits.
    template <class T>
    T read_one(std::uint64_t index = 0) const {
        return map_read<T>(index, 1)[0];
    }

    /// Copies `values` to element `first` of the same type; the values may be freed afterwards.
    template <class T, std::size_t N>
    void write(std::span<T, N> values, std::uint64_t first = 0) {
        static_assert(std::is_trivially_copyable_v<T>);
        write_bytes(std::as_bytes(values), first * sizeof(T));
    }
    template <class T>
    void write_one(const T& value, std::uint64_t index = 0) {
        write(std::span<const T, 1>(&value, 1), index);
    }

    /// Sets all of the buffer to a repeated 32-bit word, in queue order, without waiting.
    void fill(std::uint32_t word);
    /// Copies the first `bytes` of `source`, in queue order, without waiting.
    void copy_from(const Buffer& source, std::uint64_t bytes);

    const std::shared_ptr<BufferState>& state() const { return state_; }

  private:
    static constexpr std::uint64_t kRest = ~std::uint64_t{0};

    template <class T>
    Mapped<T> map(MapMode mode, std::uint64_t first, std::uint64_t count) const {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::uint64_t elements = range(first, count, sizeof(T));
        return Mapped<T>(RawMap(state_, mode, first * sizeof(T), elements * sizeof(T)),
                         static_cast<std::size_t>(elements));
    }
    std::uint64_t range(std::uint64_t first, std::uint64_t count, std::size_t size) const;
    void write_bytes(std::span<const std::byte> bytes, std::uint64_t offset);

    std::shared_ptr<BufferState> state_;
};

} // namespace macula::compute
