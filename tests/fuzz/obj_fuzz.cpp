// OBJ text through tinyobjloader, our checks and validation.
#include "fuzz.hpp"
#include "scenes/formats.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace macula::scene;
    try {
        Scene scene = load_obj(fuzz::text_of(data, size), "/nonexistent/fuzz.obj", {});
        fuzz::validate_with_view(scene);
    } catch (const SceneError&) {
    }
    return 0;
}
