#include "host/frame/geometry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/trace_scenes.hpp"

namespace {
using namespace macula;
using testing::HasSubstr;
using testing::ThrowsMessage;

scene::Scene three_meshes() {
    scene::Scene scene;
    scene.materials.resize(2);
    for (std::uint32_t seed : {1u, 2u, 3u})
        scene.meshes.push_back(test::soup(20 * seed, seed, 2));
    return scene;
}

scene::Transform moved_by(float x) {
    scene::Transform transform;
    transform.row[0][3] = x;
    return transform;
}

class Geometry : public testing::Test {
  protected:
    compute::Device device_ = compute::open();
};

TEST_F(Geometry, UnmovedMeshesBecomeOne) {
    scene::Scene scene = three_meshes();
    scene.instances = {{2, {}, ""}, {0, {}, ""}, {1, {}, ""}};
    frame::DeviceGeometry geometry(device_, scene);
    EXPECT_FALSE(geometry.instanced());
    EXPECT_EQ(geometry.statistics().meshes, 1u);
    EXPECT_EQ(geometry.statistics().triangles, scene.triangle_count());
}

TEST_F(Geometry, TriangleIdsFollowTheInstancesOfAMergedScene) {
    scene::Scene scene = three_meshes();
    scene.instances = {{2, {}, ""}, {0, {}, ""}, {1, {}, ""}};
    const frame::DeviceGeometry geometry(device_, scene);
    std::uint32_t id = 0;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const scene::Mesh& mesh = scene.meshes[scene.instances[i].mesh];
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t, ++id) {
            const frame::TriangleOrigin origin = geometry.origin_of(id);
            ASSERT_EQ(origin.mesh, scene.instances[i].mesh);
            ASSERT_EQ(origin.instance, i);
            ASSERT_EQ(origin.triangle, t);
            ASSERT_EQ(origin.material, mesh.triangle_material[t]);
            ASSERT_EQ(origin.entry, id);
        }
    }
    EXPECT_THROW(geometry.origin_of(id), std::out_of_range);
}

TEST_F(Geometry, SharedMeshesShareTableEntries) {
    scene::Scene scene = three_meshes();
    scene.instances = {{0, {}, ""}, {1, {}, ""}, {0, moved_by(2), ""}, {2, moved_by(1), ""}};
    frame::DeviceGeometry geometry(device_, scene);
    EXPECT_TRUE(geometry.instanced());
    EXPECT_EQ(geometry.statistics().meshes, 3u);
    EXPECT_EQ(geometry.statistics().instances, 4u);
    // Mesh 1 alone is merged, and so comes first.
    const auto merged = static_cast<std::uint32_t>(scene.meshes[1].triangles.size());
    const auto shared_count = static_cast<std::uint32_t>(scene.meshes[0].triangles.size());
    EXPECT_EQ(geometry.origin_of(0).instance, 1u);
    const frame::TriangleOrigin first = geometry.origin_of(merged + 5);
    const frame::TriangleOrigin second = geometry.origin_of(merged + shared_count + 5);
    EXPECT_EQ(first.instance, 0u);
    EXPECT_EQ(second.instance, 2u);
    EXPECT_EQ(first.triangle, second.triangle);
    EXPECT_EQ(first.entry, second.entry);
}

TEST_F(Geometry, OnlyTheLayoutsAskedForAreUploaded) {
    frame::DeviceGeometry geometry(device_, test::soup_scene());
    EXPECT_TRUE(geometry.layout_statistics().empty());
    geometry.layout(bvh::Layout::wide8_block);
    geometry.layout(bvh::Layout::wide8_block);
    ASSERT_EQ(geometry.layout_statistics().size(), 1u);
    EXPECT_GT(geometry.layout_statistics()[0].node_bytes, 0u);
}

TEST_F(Geometry, MasksExistOnlyWhereATexelIsNotSolid) {
    scene::Scene scene = test::masked_scene();
    EXPECT_TRUE(frame::DeviceGeometry(device_, scene).masked());
    for (scene::Texture& texture : scene.textures) {
        for (std::size_t i = 3; i < texture.levels[0].rgba.size(); i += 4)
            texture.levels[0].rgba[i] = 128;
    }
    EXPECT_FALSE(frame::DeviceGeometry(device_, scene).masked());
    scene.materials[1].alpha_cutoff = 0.51f;
    EXPECT_TRUE(frame::DeviceGeometry(device_, scene).masked());
}

TEST_F(Geometry, PreviousTransformsAreThoseOfTheLastCall) {
    scene::Scene scene = three_meshes();
    scene.instances = {{0, moved_by(1), ""}, {0, moved_by(2), ""}};
    frame::DeviceGeometry geometry(device_, scene);
    const auto x = [&](bool previous) {
        const shared::Instance& instance = geometry.instances()[0];
        return previous ? instance.previous_world_from_object[0][3]
                        : instance.world_from_object[0][3];
    };
    EXPECT_EQ(x(true), 1.0f);
    geometry.set_transforms(std::vector{moved_by(5), moved_by(2)});
    EXPECT_EQ(x(true), 1.0f);
    EXPECT_EQ(x(false), 5.0f);
    geometry.set_transforms(std::vector{moved_by(5), moved_by(2)});
    EXPECT_EQ(x(true), 5.0f);
    const auto on_device =
        geometry.layout(bvh::Layout::binary).instances.read_one<shared::Instance>(0);
    EXPECT_EQ(on_device.previous_world_from_object[0][3], 5.0f);
}

TEST_F(Geometry, WrongTransformsAreRefused) {
    scene::Scene scene = three_meshes();
    scene.instances = {{0, moved_by(1), ""}, {1, {}, ""}};
    frame::DeviceGeometry geometry(device_, scene);
    EXPECT_THROW(geometry.set_transforms(std::vector{moved_by(1)}), std::invalid_argument);
    EXPECT_THAT(
        [&] {
            geometry.set_transforms(std::vector{moved_by(1), moved_by(1)});
        },
        ThrowsMessage<std::invalid_argument>(HasSubstr("merge_static")));
    scene::Transform singular;
    singular.row[2] = {};
    EXPECT_THROW(geometry.set_transforms(std::vector{singular, scene::Transform{}}),
                 std::invalid_argument);
    EXPECT_EQ(geometry.instances()[1].world_from_object[0][3], 1.0f); // the merged one is first
}

TEST_F(Geometry, BrokenScenesAreRefused) {
    scene::Scene scene = three_meshes();
    const auto refused = [&](const char* why) {
        EXPECT_THAT([&] { frame::DeviceGeometry(device_, scene); },
                    ThrowsMessage<std::invalid_argument>(HasSubstr(why)));
    };
    refused("no triangles");
    scene.instances = {{7, {}, ""}};
    refused("mesh 7 of 3");
    scene.instances = {{0, {}, ""}, {1, {}, ""}};
    scene.meshes[0].triangles[3].y = 100000;
    refused("triangle 3: a vertex index");
    scene.meshes[0].triangles[3].y = 0;
    scene.meshes[1].triangle_material[2] = 9;
    refused("material 9 of 2");
}

} // namespace
