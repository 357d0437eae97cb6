// Unpacking with a limit: the first byte chooses the format.
#include "fuzz.hpp"
#include "scenes/input.hpp"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace macula::scene;
    constexpr std::uint64_t kLimit = 1 << 20;
    if (size == 0)
        return 0;
    const auto kind = data[0] % 2 == 0 ? Compression::gzip : Compression::zstd;
    try {
        if (decompress(fuzz::text_of(data + 1, size - 1), kind, kLimit, "fuzz").size() > kLimit)
            std::abort();
    } catch (const SceneError&) {
    }
    return 0;
}
