// Refresh rate modulation (Smith, Booth and Bailey 2014, section 3.2.1): the fovea is rendered in
// every frame, of the periphery one block of four pixels of each refresh group. The picture keeps
// what is not rendered.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "host/stage/kit.hpp"
#include "shared/rrm.h"

namespace macula::stage {

// In which order the blocks of a group take their turns.
enum class RefreshOrder {
    horizontal, // row by row
    serpentine, // the same with every other row backwards
    scattered,  // a random one, the same in all groups
    blue_noise, // each group its own, spread evenly over the image
};

// Up to so many degrees from the gaze (a rectangle, as the fovea) a block is refreshed every
// `period` frames, which divides N.
struct RefreshRing {
    float degrees;
    std::uint32_t period;
};

// Groups of a packet are refreshed `times` as often where a refreshed pixel has changed or moves.
struct BusyOptions {
    float change = 0.0f; // of a colour channel in 0..1 from what was shown; 0: whatever it is
    float motion = 0.0f; // pixels a frame, of the camera's and of the object's motion; 0: likewise
    std::uint32_t times = 4;   // 2..132, at most N
    std::uint32_t frames = 12; // that it lasts after the last change, 1..65536
    float budget = 0.05f;      // part of the picture's pixels, 0..1, that a frame may spend on it

    bool wanted() const { return change > 0.0f || motion > 0.0f; }
};

// Defaults are the paper's where it states one; ranges are checked by RefreshCycle.
struct RrmOptions {
    float fovea = 5.0f; // degrees from the gaze to the foveal rectangle's edges, 0..; 90: all
    bool disk = false;  // of that rectangle only the disk is the fovea
    std::uint32_t foveal_samples = 1; // of a foveal pixel, if more than of the others; 1..65536
    // Blocks of a refresh group, each 1..132 and 1..132 in all: N, the frames between two
    // refreshes of a peripheral block.
    std::uint32_t group_width = 3, group_height = 4;
    std::uint32_t block_width = 2; // pixels of the four along a row: 2 (2 x 2) or 4 (4 x 1)
    // The groups of a packet of sixteen pixels reach through one another, so that their due blocks
    // touch; false: each group is a rectangle by itself.
    bool interlaced = true;
    RefreshOrder order = RefreshOrder::horizontal;
    // Without history (the first frame) every pixel is rendered; false: as in any other frame, the
    // rest black.
    bool first_frame_full = true;
    // Also where the view has turned by more than half of the smaller field of view.
    bool cut_full = true;
    // Around the fovea blocks are refreshed more often: up to five rings, outwards.
    std::vector<RefreshRing> rings;
    BusyOptions busy;
};

// "horizontal" and the like. Throws std::invalid_argument.
RefreshOrder parse_refresh_order(std::string_view text);
const char* name(RefreshOrder order);
// Sets the group of N blocks that is nearest to a square of blocks. Throws std::invalid_argument
// for N out of 1..132.
void set_group(RrmOptions& options, std::uint32_t blocks);

// Pixels [x0, x1) x [y0, y1).
struct PixelRectangle {
    std::uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
};

// The smallest rectangle of whole blocks that holds every pixel of the picture whose middle lies
// within the rectangle around all points less than `degrees` (0..180) off the gaze.
PixelRectangle foveal_rectangle(const shared::FrameParams& params, float degrees,
                                std::uint32_t block_width);

// For each of MACULA_REFRESH_ORDERS^2 groups the places of its blocks in the order of their turns:
// column | row << 16, in blocks from the first block of the group's packet.
std::vector<std::uint32_t> refresh_orders(const RrmOptions& options);
// The turn of each block of those groups, row by row of the blocks.
std::vector<std::uint32_t> refresh_ranks(const RrmOptions& options);

// What is refreshed when: counts the frames and plans each one.
class RefreshCycle {
  public:
    // Throws std::invalid_argument that names the option out of range.
    RefreshCycle(const RrmOptions& options, std::uint32_t width, std::uint32_t height);

    // Of the next frame; `first`: it has no history.
    const shared::RefreshPlan& plan(const shared::FrameParams& params, bool first);
    // Before each pixel sample of the frame: sets what used_slots() points to.
    void begin_sample(std::uint32_t sample);
    // Packets' groups that the picture has.
    std::uint32_t quads() const;

    const RrmOptions& options() const { return options_; }
    // Slots that the launches of the planned frame cover: for Kit::used_slots.
    std::shared_ptr<const std::uint32_t> used_slots() const { return used_slots_; }

  private:
    void add_fovea(const PixelRectangle& pixels);
    void add_periphery(const shared::FrameParams& params);
    void make_full();
    void plan_busy();
    void add_region(const PixelRectangle& packets, std::uint32_t period);
    void add_around(const PixelRectangle& hole, const PixelRectangle& all, std::uint32_t period);

    RrmOptions options_;
    std::uint32_t width_, height_;
    std::uint32_t most_packets_; // that memory has room for
    std::uint64_t frame_ = 0;    // the next one, since the first
    shared::RefreshPlan plan_{};
    std::shared_ptr<std::uint32_t> used_slots_;
};

// True where the view has turned by more than half of the smaller field of view.
bool is_cut(const shared::FrameParams& params);

struct RrmKit {
    Kit kit; // with used_slots
    std::shared_ptr<RefreshCycle> cycle;
};

// Writes "refresh plan" (RefreshPlan): what the frame refreshes; and where busy groups are looked
// for, "busy until" (uint a quad of groups), "busy quads" and "busy quad count".
frame::Stage plan_refresh(const RrmKit& kit);

// Writes "primary rays", "pixel of slot" and "ray count": the pixels that are refreshed. For within
// for_each_sample.
frame::Stage refreshed_rays(const RrmKit& kit);

// The mean of the samples of "colour" resource `from` -> the refreshed pixels of "colour". The
// picture stays where it is from frame to frame: the others keep what they show.
frame::Stage keep_refreshed(const RrmKit& kit, const std::string& from);

// Refreshed pixels -> "refreshed at", for within for_each_sample; -> "cache age" (uint a pixel:
// frames since the refresh, 2^20 - 1: none yet).
frame::Stage note_refresh(const RrmKit& kit);
frame::Stage show_age(const RrmKit& kit);

// A stage that writes the image's pixels of a list, for images that stay where they are from frame
// to frame. They begin black. `foveal`: it knows the samples that the fovea alone has.
frame::Stage persistent(frame::Stage stage, bool foveal = false);

} // namespace macula::stage
