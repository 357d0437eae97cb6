#include "host/cl/huge_pages.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace macula::compute {

#if defined(__linux__)

void prefer_huge_pages(void* data, std::uint64_t bytes) {
    // Whole pages only: madvise() takes no others, and the ends may hold something else.
    const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    const std::uint64_t skipped = (page - reinterpret_cast<std::uintptr_t>(data) % page) % page;
    if (bytes >= skipped + page)
        madvise(static_cast<std::byte*>(data) + skipped, (bytes - skipped) / page * page,
                MADV_HUGEPAGE);
}

#else

void prefer_huge_pages(void*, std::uint64_t) {}

#endif

} // namespace macula::compute
