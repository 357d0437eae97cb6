// Large pages for the large buffers of CPU devices.
#pragma once

#include <cstddef>
#include <cstdint>

namespace macula::compute {

// Smaller buffers are not worth a large page.
constexpr std::uint64_t kLeastHugeBytes = 4u << 20;

// Asks the operating system to back untouched memory with large pages: rays that have little in
// common touch nodes and triangles all over the scene, more pages than the processor can translate
// at once. A hint: where it is refused, or unknown, nothing changes.
void prefer_huge_pages(void* data, std::uint64_t bytes);

} // namespace macula::compute
