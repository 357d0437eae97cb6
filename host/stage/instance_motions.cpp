#include "host/stage/instance_motions.hpp"

#include <algorithm>
#include <map>

#include <glm/glm.hpp>

namespace macula::stage {
namespace {

glm::dmat4 matrix_of(const float (&rows)[3][4]) {
    glm::dmat4 m(1.0);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            m[column][row] = rows[row][column];
    return m;
}

bool has_moved(const shared::Instance& i) {
    return !std::equal(&i.world_from_object[0][0], &i.world_from_object[0][0] + 12,
                       &i.previous_world_from_object[0][0]);
}

WorldMotion motion_of(const shared::Instance& i) {
    const glm::dmat4 m =
        matrix_of(i.world_from_object) * glm::inverse(matrix_of(i.previous_world_from_object));
    WorldMotion rows;
    for (std::size_t k = 0; k < rows.size(); ++k)
        rows[k] = static_cast<float>(m[static_cast<int>(k % 4)][static_cast<int>(k / 4)]);
    return rows;
}

} // namespace

MotionTables find_motions(std::span<const shared::Instance> instances) {
    MotionTables tables;
    tables.instances.reserve(instances.size());
    std::map<WorldMotion, std::uint32_t> numbers;
    for (const shared::Instance& i : instances) {
        std::uint32_t number = 0;
        if (has_moved(i)) {
            const auto next = static_cast<std::uint32_t>(tables.matrices.size() + 1);
            const auto [known, is_new] = numbers.try_emplace(motion_of(i), next);
            if (is_new)
                tables.matrices.push_back(known->first);
            number = known->second;
        }
        tables.instances.push_back({i.first_triangle, number});
    }
    return tables;
}

void InstanceMotions::update(const Kit& kit) {
    const auto instances = kit.geometry.instances();
    moved_ =
        static_cast<std::uint32_t>(std::count_if(instances.begin(), instances.end(), has_moved));
    count_ = static_cast<std::uint32_t>(instances.size());
    if (moved_ == 0)
        return;
    const MotionTables tables = find_motions(instances);
    if (!table) {
        table = kit.device.allocate_array<shared::InstanceMotion>(count_, "motions of instances");
        matrices = kit.device.allocate_array<WorldMotion>(count_, "matrices of motions");
    }
    table.write(std::span(tables.instances));
    matrices.write(std::span(tables.matrices));
}

} // namespace macula::stage
