// Scene files over a small built-in scene.
#include "fuzz.hpp"
#include "scenes/formats.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace macula::scene;
    try {
        Scene scene = load_scene_file("procedural = 'cornell'\n" + fuzz::text_of(data, size),
                                      "/nonexistent/fuzz.toml", {});
        validate(scene);
    } catch (const SceneError&) {
    }
    return 0;
}
