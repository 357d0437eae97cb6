#include "bvh/layout_formats.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bvh/octant_slots.hpp"

#include "shared/ray.h"

namespace macula::bvh {
namespace {

std::uint32_t stored_id(const Geometry& geometry, std::uint32_t id) {
    return id | (!geometry.masked.empty() && geometry.masked[id] != 0 ? MACULA_MASKED_BIT : 0u);
}

const float* position(const Geometry& geometry, std::uint32_t triangle, std::uint32_t corner) {
    return geometry.positions.data() + std::size_t{3} * geometry.triangles[triangle][corner];
}

// The plane `q` of a quantised box, as kernels decode it.
float decode(std::uint32_t q, std::uint32_t exponent, float origin) {
    return std::fma(static_cast<float>(q), std::bit_cast<float>(exponent << 23), origin);
}

// Biased exponent of the least power of two by which 255 steps from lo reach hi. Steps are kept so
// large that no step is lost in rounding and none is denormal.
std::uint32_t exponent_for(float lo, float hi) {
    const int of_extent = std::ilogb(std::max(hi - lo, 1e-30f)) - 7;
    const int of_rounding = std::ilogb(std::max({std::fabs(lo), std::fabs(hi), 1e-30f})) - 23;
    auto exponent = static_cast<std::uint32_t>(std::max(of_extent, of_rounding) + 127);
    while (decode(255, exponent, lo) < hi)
        ++exponent;
    return exponent;
}

shared::uchar quantise_down(float plane, std::uint32_t exponent, float origin) {
    const float step = std::bit_cast<float>(exponent << 23);
    auto q = static_cast<std::uint32_t>(std::clamp((plane - origin) / step, 0.0f, 255.0f));
    while (q > 0 && decode(q, exponent, origin) > plane)
        --q;
    return static_cast<shared::uchar>(q);
}

shared::uchar quantise_up(float plane, std::uint32_t exponent, float origin) {
    std::uint32_t q = quantise_down(plane, exponent, origin);
    while (q < 255 && decode(q, exponent, origin) < plane)
        ++q;
    return static_cast<shared::uchar>(q);
}

} // namespace

void write_node(shared::BinaryNode& node, const Box&, std::span<const Child> children) {
    node = {};
    for (std::size_t i = 0; i < 2; ++i) {
        const Child child = i < children.size() ? children[i] : Child{kEmptyBox, -1};
        for (int axis = 0; axis < 3; ++axis) {
            node.box[i][axis][0] = child.box.lo[axis];
            node.box[i][axis][1] = child.box.hi[axis];
        }
        node.child[i] = child.reference;
    }
}

void write_node(shared::Wide8Node& node, const Box&, std::span<const Child> children) {
    node = {};
    for (std::size_t i = 0; i < 8; ++i) {
        const Child child = i < children.size() ? children[i] : Child{kEmptyBox, -1};
        for (int axis = 0; axis < 3; ++axis) {
            node.plane[axis][0][i] = child.box.lo[axis];
            node.plane[axis][1][i] = child.box.hi[axis];
        }
        node.child[i] = child.reference;
    }
}

void write_node(shared::Quantized8Node& node, const Box& box, std::span<const Child> children) {
    node = {};
    std::fill_n(node.child, 8, -1);
    const std::array<std::uint8_t, 8> slots = octant_slots(box, children);
    for (std::size_t i = 0; i < children.size(); ++i) {
        node.child[slots[i]] = children[i].reference;
        node.exponent |= 1u << (24 + slots[i]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const float origin = box.lo[axis];
        const std::uint32_t exponent = exponent_for(origin, box.hi[axis]);
        node.origin[axis] = origin;
        node.exponent |= exponent << (8 * axis);
        std::fill_n(node.lo[axis], 8, shared::uchar{255});
        for (std::size_t i = 0; i < children.size(); ++i) {
            const std::size_t slot = slots[i];
            node.lo[axis][slot] = quantise_down(children[i].box.lo[axis], exponent, origin);
            node.hi[axis][slot] = quantise_up(children[i].box.hi[axis], exponent, origin);
        }
    }
}

std::uint32_t entries_for(const shared::Triangle*, std::uint32_t triangles) {
    return triangles;
}

std::uint32_t entries_for(const shared::TriangleBlock8*, std::uint32_t triangles) {
    return (triangles + 7) / 8;
}

void write_leaf(shared::Triangle* entries, const Geometry& geometry,
                std::span<const std::uint32_t> ids) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
        shared::Triangle& triangle = entries[i];
        triangle = {};
        std::memcpy(triangle.v0, position(geometry, ids[i], 0), sizeof triangle.v0);
        std::memcpy(triangle.v1, position(geometry, ids[i], 1), sizeof triangle.v1);
        std::memcpy(triangle.v2, position(geometry, ids[i], 2), sizeof triangle.v2);
        triangle.id = stored_id(geometry, ids[i]);
    }
}

void write_leaf(shared::TriangleBlock8* entries, const Geometry& geometry,
                std::span<const std::uint32_t> ids) {
    for (std::size_t i = 0; i < entries_for(entries, static_cast<std::uint32_t>(ids.size())); ++i) {
        entries[i] = {};
        std::fill_n(entries[i].id, 8, MACULA_NO_TRIANGLE);
    }
    for (std::size_t i = 0; i < ids.size(); ++i) {
        shared::TriangleBlock8& block = entries[i / 8];
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const float* p = position(geometry, ids[i], corner);
            for (int axis = 0; axis < 3; ++axis)
                block.v[corner][axis][i % 8] = p[axis];
        }
        block.id[i % 8] = stored_id(geometry, ids[i]);
    }
}

} // namespace macula::bvh
