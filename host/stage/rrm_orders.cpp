// In which order the blocks of a refresh group take their turns.
#include "host/stage/rrm.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "host/frame/blue_noise.hpp"
#include "lib/random.h"
#include "shared/blue_noise.h"

namespace macula::stage {
namespace {

constexpr std::array kNames = {"horizontal", "serpentine", "scattered", "blue_noise"};
constexpr std::uint32_t kOrders = MACULA_REFRESH_ORDERS;

// Blocks in the order of their keys, lowest first.
template <class Key>
std::vector<std::uint32_t> sorted_by(std::uint32_t blocks, Key key) {
    std::vector<std::uint32_t> order(blocks);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    return order;
}

// Where a block of the group (x, y) lies: column | row << 16 from the first block of its packet.
std::uint32_t place_in_packet(const RrmOptions& o, std::uint32_t x, std::uint32_t y,
                              std::uint32_t block) {
    const std::uint32_t across = 4 / o.block_width, down = o.block_width; // groups of a packet
    const std::uint32_t column = block % o.group_width, row = block / o.group_width;
    if (o.interlaced)
        return (column * across + x % across) | (row * down + y % down) << 16;
    return (x % across * o.group_width + column) | (y % down * o.group_height + row) << 16;
}

std::vector<std::uint32_t> order_of_group(const RrmOptions& o, std::uint32_t group_x,
                                          std::uint32_t group_y,
                                          const std::vector<std::uint16_t>& mask) {
    const std::uint32_t blocks = o.group_width * o.group_height;
    const std::uint32_t across = 4 / o.block_width, down = o.block_width; // groups of a packet
    return sorted_by(blocks, [&](std::uint32_t block) -> std::uint32_t {
        const std::uint32_t x = block % o.group_width, y = block / o.group_width;
        switch (o.order) {
        case RefreshOrder::horizontal:
            return block;
        case RefreshOrder::serpentine:
            return y * o.group_width + (y % 2 == 0 ? x : o.group_width - 1 - x);
        case RefreshOrder::scattered:
            return shared::random_bits(0, block, 0);
        case RefreshOrder::blue_noise:
            break;
        }
        constexpr std::uint32_t side = MACULA_NOISE_SIDE;
        const std::uint32_t at = place_in_packet(o, group_x, group_y, block);
        const std::uint32_t column = group_x / across * across * o.group_width + (at & 0xffffu);
        const std::uint32_t row = group_y / down * down * o.group_height + (at >> 16);
        return mask[row % side * side + column % side];
    });
}

} // namespace

RefreshOrder parse_refresh_order(std::string_view text) {
    for (std::size_t i = 0; i < kNames.size(); ++i)
        if (text == kNames[i])
            return static_cast<RefreshOrder>(i);
    throw std::invalid_argument(
        fmt::format("there is no refresh order \"{}\": horizontal, serpentine, scattered or "
                    "blue_noise was expected",
                    text));
}

const char* name(RefreshOrder order) {
    return kNames[static_cast<std::size_t>(order)];
}

void set_group(RrmOptions& options, std::uint32_t blocks) {
    if (blocks < 1 || blocks > 132)
        throw std::invalid_argument(
            fmt::format("method rrm: N is 1 to 132 frames, not {}", blocks));
    // The widest group that is not wider than high, in blocks.
    for (std::uint32_t width = 1; width * width <= blocks; ++width)
        if (blocks % width == 0)
            options.group_width = width;
    options.group_height = blocks / options.group_width;
}

std::vector<std::uint32_t> refresh_orders(const RrmOptions& options) {
    const std::vector<std::uint16_t> mask = options.order == RefreshOrder::blue_noise
                                                ? frame::make_blue_noise(1)
                                                : std::vector<std::uint16_t>();
    std::vector<std::uint32_t> orders;
    for (std::uint32_t group = 0; group < kOrders * kOrders; ++group) {
        const std::uint32_t x = group % kOrders, y = group / kOrders;
        for (const std::uint32_t block : order_of_group(options, x, y, mask))
            orders.push_back(place_in_packet(options, x, y, block));
    }
    return orders;
}

std::vector<std::uint32_t> refresh_ranks(const RrmOptions& options) {
    const std::uint32_t across = 4 / options.block_width, down = options.block_width;
    const std::uint32_t blocks = options.group_width * options.group_height;
    const std::uint32_t wide = kOrders * options.group_width;
    const std::vector<std::uint32_t> orders = refresh_orders(options);
    std::vector<std::uint32_t> ranks(orders.size());
    for (std::uint32_t i = 0; i < orders.size(); ++i) {
        const std::uint32_t group = i / blocks;
        const std::uint32_t quad_x = group % kOrders / across, quad_y = group / kOrders / down;
        const std::uint32_t x = quad_x * across * options.group_width + (orders[i] & 0xffffu);
        const std::uint32_t y = quad_y * down * options.group_height + (orders[i] >> 16);
        ranks[y * wide + x] = i % blocks;
    }
    return ranks;
}

} // namespace macula::stage
