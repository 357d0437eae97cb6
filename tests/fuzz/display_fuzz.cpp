// Display files, TOML and JSON.
#include "fuzz.hpp"
#include "scenes/display.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace macula::scene;
    if (size == 0)
        return 0;
    try {
        parse_display(fuzz::text_of(data + 1, size - 1), "fuzz", data[0] % 2 == 1);
    } catch (const SceneError&) {
    }
    return 0;
}
