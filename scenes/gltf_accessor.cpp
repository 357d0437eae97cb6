// Reading of glTF accessors. tinygltf hands them over as written: every offset is checked here.
#include <algorithm>
#include <cstring>
#include <limits>

#include "scenes/gltf_document.hpp"
#include "scenes/validate.hpp"

namespace macula::scene {
namespace {

// Elements of one accessor; more could not be vertices of a scene that fits kMaxTriangles.
constexpr std::size_t kMaxElements = 3 * kMaxTriangles;
// Elements of an accessor without data, which are zero until sparse values replace them.
constexpr std::size_t kMaxZeroElements = std::size_t{1} << 24;

template <typename T>
T load(const unsigned char* data) {
    T value;
    std::memcpy(&value, data, sizeof value);
    return value;
}

template <typename T>
float from_integer(const unsigned char* data, bool normalized) {
    const auto value = static_cast<float>(load<T>(data));
    if (!normalized)
        return value;
    return std::max(-1.0f, value / static_cast<float>(std::numeric_limits<T>::max()));
}

float to_float(const unsigned char* data, int type, bool normalized) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return load<float>(data);
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return from_integer<std::int8_t>(data, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return from_integer<std::uint8_t>(data, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return from_integer<std::int16_t>(data, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return from_integer<std::uint16_t>(data, normalized);
    default:
        return from_integer<std::uint32_t>(data, normalized);
    }
}

std::uint32_t to_unsigned(const unsigned char* data, int type) {
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
        return *data;
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? load<std::uint16_t>(data)
                                                          : load<std::uint32_t>(data);
}

bool is_index_type(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// Bytes of a component, 0 for a type that scenes do not use.
std::size_t component_size(int type) {
    if (type == TINYGLTF_COMPONENT_TYPE_FLOAT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        return 4;
    if (type == TINYGLTF_COMPONENT_TYPE_SHORT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
        return 2;
    const bool byte =
        type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    return byte ? 1 : 0;
}

} // namespace

std::span<const unsigned char> GltfDocument::view_bytes(int view, const std::string& where) const {
    if (view < 0 || static_cast<std::size_t>(view) >= model_.bufferViews.size())
        fail(where, "buffer view " + std::to_string(view) + " does not exist");
    const tinygltf::BufferView& bounds = model_.bufferViews[static_cast<std::size_t>(view)];
    if (bounds.buffer < 0 || static_cast<std::size_t>(bounds.buffer) >= model_.buffers.size())
        fail(where, "buffer " + std::to_string(bounds.buffer) + " does not exist");
    const std::vector<unsigned char>& data =
        model_.buffers[static_cast<std::size_t>(bounds.buffer)].data;
    if (bounds.byteOffset > data.size() || bounds.byteLength > data.size() - bounds.byteOffset)
        fail(where, "buffer view " + std::to_string(view) + " goes beyond its buffer of " +
                        std::to_string(data.size()) + " bytes");
    return {data.data() + bounds.byteOffset, bounds.byteLength};
}

GltfDocument::Elements GltfDocument::elements(int index, const std::string& where) const {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size())
        fail(where, "accessor " + std::to_string(index) + " does not exist");
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
    const std::string name = "accessor " + std::to_string(index);
    const std::size_t size = component_size(accessor.componentType);
    const int components =
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (size == 0 || components < 1)
        fail(where, name + " has an unknown type");
    if (accessor.count > kMaxElements)
        fail(where, name + " has " + std::to_string(accessor.count) + " elements, more than " +
                        std::to_string(kMaxElements));
    Elements result{nullptr,
                    accessor.count,
                    size * static_cast<std::size_t>(components),
                    static_cast<std::size_t>(components),
                    accessor.componentType,
                    accessor.normalized};
    if (accessor.bufferView < 0 && accessor.sparse.isSparse) {
        if (accessor.count > kMaxZeroElements)
            fail(where, name + " consists of " + std::to_string(accessor.count) + " zeros");
        return result;
    }
    const std::span<const unsigned char> bytes = view_bytes(accessor.bufferView, where);
    const std::size_t stride =
        model_.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
    const std::size_t element = result.stride;
    if (stride != 0)
        result.stride = stride;
    if (stride != 0 && stride < element)
        fail(where, name + ": its stride is shorter than an element");
    const bool fits =
        accessor.byteOffset <= bytes.size() &&
        (accessor.count == 0 ||
         (bytes.size() - accessor.byteOffset >= element &&
          (accessor.count - 1) <= (bytes.size() - accessor.byteOffset - element) / result.stride));
    if (!fits)
        fail(where, name + " goes beyond its buffer view");
    result.data = bytes.data() + accessor.byteOffset;
    return result;
}

// Calls read(element, data) for the replaced elements of a sparse accessor.
template <typename Read>
void GltfDocument::apply_sparse(const tinygltf::Accessor& accessor, const Elements& elements,
                                const std::string& where, Read&& read) const {
    if (!accessor.sparse.isSparse)
        return;
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
        !is_index_type(sparse.indices.componentType))
        fail(where, "a sparse accessor is malformed");
    const auto count = static_cast<std::size_t>(sparse.count);
    const auto index_offset = static_cast<std::size_t>(sparse.indices.byteOffset);
    const auto value_offset = static_cast<std::size_t>(sparse.values.byteOffset);
    const std::size_t index_size = component_size(sparse.indices.componentType);
    const std::size_t value_size = component_size(elements.type) * elements.components;
    const auto indices_view = view_bytes(sparse.indices.bufferView, where);
    const auto values_view = view_bytes(sparse.values.bufferView, where);
    if (index_offset > indices_view.size() || value_offset > values_view.size() ||
        count > (indices_view.size() - index_offset) / index_size ||
        count > (values_view.size() - value_offset) / value_size)
        fail(where, "a sparse accessor goes beyond its buffer view");
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t element = to_unsigned(
            indices_view.data() + index_offset + i * index_size, sparse.indices.componentType);
        if (element >= elements.count)
            fail(where, "a sparse accessor replaces element " + std::to_string(element) + " of " +
                            std::to_string(elements.count));
        read(element, values_view.data() + value_offset + i * value_size);
    }
}

std::vector<float> GltfDocument::floats(int accessor, int components,
                                        const std::string& where) const {
    const Elements source = elements(accessor, where);
    if (source.components != static_cast<std::size_t>(components))
        fail(where, "accessor " + std::to_string(accessor) + " has " +
                        std::to_string(source.components) + " components, " +
                        std::to_string(components) + " were expected");
    std::vector<float> values(source.count * source.components);
    const std::size_t size = component_size(source.type);
    const auto read = [&](std::size_t element, const unsigned char* data) {
        for (std::size_t c = 0; c < source.components; ++c)
            values[element * source.components + c] =
                to_float(data + c * size, source.type, source.normalized);
    };
    for (std::size_t i = 0; source.data != nullptr && i < source.count; ++i)
        read(i, source.data + i * source.stride);
    apply_sparse(model_.accessors[static_cast<std::size_t>(accessor)], source, where, read);
    return values;
}

std::vector<std::uint32_t> GltfDocument::indices(int accessor, const std::string& where) const {
    const Elements source = elements(accessor, where);
    if (source.components != 1 || !is_index_type(source.type))
        fail(where, "accessor " + std::to_string(accessor) + " holds no unsigned indices");
    std::vector<std::uint32_t> values(source.count);
    const auto read = [&](std::size_t element, const unsigned char* data) {
        values[element] = to_unsigned(data, source.type);
    };
    for (std::size_t i = 0; source.data != nullptr && i < source.count; ++i)
        read(i, source.data + i * source.stride);
    apply_sparse(model_.accessors[static_cast<std::size_t>(accessor)], source, where, read);
    return values;
}

} // namespace macula::scene
