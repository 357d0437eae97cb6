#include <algorithm>
#include <limits>

#include "scenes/procedural/voxel.hpp"

namespace macula::scene::procedural {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Lattice points of the layers below and above the blocks being meshed.
class Lattice {
  public:
    explicit Lattice(int size)
        : side_(static_cast<std::size_t>(size) + 1), low_(side_ * side_, kNone),
          high_(side_ * side_, kNone) {}

    void next_layer() {
        low_.swap(high_);
        std::fill(high_.begin(), high_.end(), kNone);
    }

    std::uint32_t vertex(Mesh& mesh, int x, int y, int z, bool high) {
        auto& index =
            (high ? high_
                  : low_)[static_cast<std::size_t>(z) * side_ + static_cast<std::size_t>(x)];
        if (index == kNone) {
            index = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.emplace_back(x, y + (high ? 1 : 0), z);
        }
        return index;
    }

  private:
    std::size_t side_;
    std::vector<std::uint32_t> low_, high_;
};

// The neighbour's offset and the face's four corners, counter-clockwise from outside.
struct Face {
    std::int8_t dx, dy, dz;
    std::int8_t corner[4][3];
};
constexpr Face kFaces[6] = {
    {-1, 0, 0, {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}},
    {1, 0, 0, {{1, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}},
    {0, -1, 0, {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}},
    {0, 1, 0, {{0, 1, 1}, {1, 1, 1}, {1, 1, 0}, {0, 1, 0}}},
    {0, 0, -1, {{1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 1, 0}}},
    {0, 0, 1, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
};

bool face_shows(const VoxelGrid& grid, int x, int y, int z, const Face& face) {
    if (y + face.dy < 0)
        return false;
    return grid.at(x + face.dx, y + face.dy, z + face.dz) == Block::air;
}

template <class Visit>
void for_solid_blocks(const VoxelGrid& grid, int y, Visit&& visit) {
    const Block* block = grid.layer(y);
    for (int z = 0; z < grid.size(); ++z)
        for (int x = 0; x < grid.size(); ++x, ++block)
            if (*block != Block::air)
                visit(x, z, *block);
}

std::size_t count_faces(const VoxelGrid& grid) {
    std::size_t count = 0;
    for (int y = 0; y < grid.height(); ++y)
        for_solid_blocks(grid, y, [&](int x, int z, Block) {
            for (const Face& face : kFaces)
                count += face_shows(grid, x, y, z, face) ? 1 : 0;
        });
    return count;
}

std::uint32_t material_of(Block block, int x, int y, int z) {
    const std::uint32_t tone = hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                    static_cast<std::uint32_t>(z), 77u) %
                               kTones;
    return (static_cast<std::uint32_t>(block) - 1) * kTones + tone;
}

} // namespace

VoxelGrid::VoxelGrid(int size, int height)
    : size_(size), height_(height),
      blocks_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) *
                  static_cast<std::size_t>(height),
              Block::air) {}

void VoxelGrid::fill(glm::ivec3 lo, glm::ivec3 hi, Block block) {
    lo = glm::max(lo, glm::ivec3{0});
    hi = glm::min(hi, glm::ivec3{size_ - 1, height_ - 1, size_ - 1});
    for (int y = lo.y; y <= hi.y; ++y)
        for (int z = lo.z; z <= hi.z; ++z)
            for (int x = lo.x; x <= hi.x; ++x)
                blocks_[index(x, y, z)] = block;
}

int VoxelGrid::top(int x, int z) const {
    if (!contains(x, 0, z))
        return 0;
    int y = height_;
    while (y > 0 && blocks_[index(x, y - 1, z)] == Block::air)
        --y;
    return y;
}

Mesh voxel_surface(const VoxelGrid& grid) {
    Mesh mesh;
    mesh.name = "voxels";
    const std::size_t faces = count_faces(grid);
    mesh.triangles.reserve(2 * faces);
    mesh.triangle_material.reserve(2 * faces);
    Lattice lattice(grid.size());
    for (int y = 0; y < grid.height(); ++y) {
        for_solid_blocks(grid, y, [&](int x, int z, Block block) {
            for (const Face& face : kFaces) {
                if (!face_shows(grid, x, y, z, face))
                    continue;
                std::uint32_t v[4];
                for (int k = 0; k < 4; ++k) {
                    const auto& c = face.corner[k];
                    v[k] = lattice.vertex(mesh, x + c[0], y, z + c[2], c[1] != 0);
                }
                mesh.triangles.push_back({v[0], v[1], v[2]});
                mesh.triangles.push_back({v[0], v[2], v[3]});
                mesh.triangle_material.insert(mesh.triangle_material.end(), 2,
                                              material_of(block, x, y, z));
            }
        });
        lattice.next_layer();
    }
    mesh.positions.shrink_to_fit();
    return mesh;
}

} // namespace macula::scene::procedural
