// MTL text through our checks and tinyobjloader; textures are not read.
#include "fuzz.hpp"
#include "scenes/obj_materials.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace macula::scene;
    Scene scene;
    TextureSet textures(scene, false);
    ObjMaterials materials(scene, textures, "/nonexistent", 1 << 20);
    try {
        materials.parse(fuzz::text_of(data, size), "fuzz.mtl");
        materials.find("a");
    } catch (const SceneError&) {
    }
    return 0;
}
