// The curved parts of the kit.
#include <algorithm>
#include <cmath>
#include <utility>

#include "scenes/procedural/kit.hpp"
#include "scenes/procedural/random.hpp"

namespace macula::scene::procedural {
namespace {

constexpr float kSharpCosine = 0.82f; // corners over about 35 degrees stay sharp

// Accumulates quad normals at the grid's points; closed sides share theirs.
std::vector<glm::vec3> grid_normals(GridShape shape, std::span<const glm::vec3> points) {
    const int columns = shape.columns, rows = shape.rows;
    std::vector<glm::vec3> normals(points.size(), glm::vec3{0.0f});
    const auto index = [&](int i, int j) {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(i);
    };
    for (int j = 0; j + 1 < rows; ++j)
        for (int i = 0; i + 1 < columns; ++i) {
            const glm::vec3 n = glm::cross(points[index(i + 1, j + 1)] - points[index(i, j)],
                                           points[index(i, j + 1)] - points[index(i + 1, j)]);
            for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
                normals[index(i + di, j + dj)] += n;
        }
    if (shape.closed_columns)
        for (int j = 0; j < rows; ++j)
            normals[index(0, j)] = normals[index(columns - 1, j)] =
                normals[index(0, j)] + normals[index(columns - 1, j)];
    if (shape.closed_rows)
        for (int i = 0; i < columns; ++i)
            normals[index(i, 0)] = normals[index(i, rows - 1)] =
                normals[index(i, 0)] + normals[index(i, rows - 1)];
    for (glm::vec3& n : normals) {
        const float length = glm::length(n);
        n = length > 0.0f ? n / length : glm::vec3{0.0f, 1.0f, 0.0f};
    }
    return normals;
}

// First and last index of each smooth run of a polyline.
std::vector<std::pair<std::size_t, std::size_t>> smooth_runs(std::span<const glm::vec2> line) {
    std::vector<std::pair<std::size_t, std::size_t>> runs;
    std::size_t first = 0;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        const glm::vec2 before = line[i] - line[i - 1], after = line[i + 1] - line[i];
        const float scale = glm::length(before) * glm::length(after);
        if (glm::dot(before, after) < kSharpCosine * scale) {
            runs.emplace_back(first, i);
            first = i;
        }
    }
    runs.emplace_back(first, line.size() - 1);
    return runs;
}

std::vector<float> running_length(std::span<const glm::vec2> line) {
    std::vector<float> length(line.size(), 0.0f);
    for (std::size_t i = 1; i < line.size(); ++i)
        length[i] = length[i - 1] + glm::length(line[i] - line[i - 1]);
    return length;
}

} // namespace

void surface(MeshBuilder& b, GridShape shape, std::span<const glm::vec3> points,
             std::span<const glm::vec2> uvs, std::uint32_t material) {
    const std::vector<glm::vec3> normals = grid_normals(shape, points);
    const auto first = static_cast<std::uint32_t>(b.mesh().positions.size());
    for (std::size_t k = 0; k < points.size(); ++k)
        b.vertex(points[k], normals[k], uvs[k]);
    const auto columns = static_cast<std::uint32_t>(shape.columns);
    for (int j = 0; j + 1 < shape.rows; ++j)
        for (int i = 0; i + 1 < shape.columns; ++i) {
            const std::uint32_t at = first + static_cast<std::uint32_t>(j * shape.columns + i);
            b.quad(at, at + 1, at + 1 + columns, at + columns, material);
        }
}

void surface(MeshBuilder& b, glm::ivec2 cells, const std::function<glm::vec3(float, float)>& point,
             const std::function<glm::vec2(float, float)>& uv, std::uint32_t material) {
    std::vector<glm::vec3> points;
    std::vector<glm::vec2> uvs;
    for (int j = 0; j <= cells.y; ++j)
        for (int i = 0; i <= cells.x; ++i) {
            const float s = static_cast<float>(i) / static_cast<float>(cells.x),
                        t = static_cast<float>(j) / static_cast<float>(cells.y);
            points.push_back(point(s, t));
            uvs.push_back(uv(s, t));
        }
    surface(b, {cells.x + 1, cells.y + 1}, points, uvs, material);
}

void revolve(MeshBuilder& b, std::span<const glm::vec2> profile, const Revolution& how,
             Finish finish) {
    float widest = 0.0f;
    for (const glm::vec2& p : profile)
        widest = std::max(widest, p.x);
    const float sweep_turns = how.to_turn - how.from_turn;
    // A whole number of repeats round a full turn, so that the seam does not show.
    const float repeats =
        std::max(1.0f, std::floor(6.2831853f * widest * sweep_turns / finish.tile + 0.5f));
    const std::vector<float> length = running_length(profile);
    const bool closed = sweep_turns == 1.0f;
    for (const auto& [first, last] : smooth_runs(profile)) {
        std::vector<glm::vec3> points;
        std::vector<glm::vec2> uvs;
        for (std::size_t j = first; j <= last; ++j)
            for (int i = 0; i <= how.segments; ++i) {
                const float s = static_cast<float>(i) / static_cast<float>(how.segments);
                // The last column of a full turn is bit for bit the first one.
                const float turn =
                    how.from_turn + (closed && i == how.segments ? 0.0f : s) * sweep_turns;
                const glm::vec2 cs = sin_cos_turns(turn);
                const float r =
                    profile[j].x * (how.modulation ? how.modulation(turn, profile[j].y) : 1.0f);
                points.emplace_back(r * cs.x, profile[j].y, -r * cs.y);
                uvs.emplace_back(s * repeats, length[j] / finish.tile);
            }
        surface(b, {how.segments + 1, static_cast<int>(last - first + 1), closed, false}, points,
                uvs, finish.material);
    }
}

void sweep(MeshBuilder& b, std::span<const glm::vec2> section, std::span<const Station> stations,
           Finish finish) {
    const std::vector<float> across = running_length(section);
    std::vector<float> travelled(stations.size(), 0.0f);
    for (std::size_t i = 1; i < stations.size(); ++i)
        travelled[i] =
            travelled[i - 1] + glm::length(stations[i].position - stations[i - 1].position);
    const bool ring = stations.size() > 2 && stations.front().position == stations.back().position;
    const auto runs = smooth_runs(section);
    const bool closed_section =
        section.size() > 3 && section.front() == section.back() && runs.size() == 1;
    for (const auto& [first, last] : runs) {
        std::vector<glm::vec3> points;
        std::vector<glm::vec2> uvs;
        for (std::size_t j = first; j <= last; ++j)
            for (std::size_t i = 0; i < stations.size(); ++i) {
                const Station& at = stations[i];
                points.push_back(at.position + at.right * section[j].x + at.up * section[j].y);
                uvs.emplace_back(travelled[i] / finish.tile, across[j] / finish.tile);
            }
        surface(b,
                {static_cast<int>(stations.size()), static_cast<int>(last - first + 1), ring,
                 closed_section},
                points, uvs, finish.material);
    }
}

void tube(MeshBuilder& b, std::span<const glm::vec3> line, float radius, int sides, Finish finish) {
    std::vector<glm::vec2> circle;
    for (int i = 0; i <= sides; ++i)
        circle.push_back(radius *
                         sin_cos_turns(static_cast<float>(i % sides) / static_cast<float>(sides)));
    std::vector<Station> stations;
    glm::vec3 right{0.0f};
    for (std::size_t i = 0; i < line.size(); ++i) {
        const glm::vec3 tangent =
            glm::normalize(line[std::min(i + 1, line.size() - 1)] - line[i == 0 ? 0 : i - 1]);
        // Parallel transport: the last frame's right, made orthogonal to the new tangent.
        if (i == 0)
            right = along(line[0], tangent).x;
        right = glm::normalize(right - tangent * glm::dot(right, tangent));
        stations.push_back({line[i], right, glm::cross(right, tangent)});
    }
    sweep(b, circle, stations, finish);
}

void sphere(MeshBuilder& b, glm::vec3 centre, float radius, glm::ivec2 cells, Finish finish) {
    const auto first = static_cast<std::uint32_t>(b.mesh().positions.size());
    const float around = std::max(1.0f, std::floor(6.2831853f * radius / finish.tile + 0.5f));
    for (int j = 0; j <= cells.y; ++j)
        for (int i = 0; i <= cells.x; ++i) {
            const float s = static_cast<float>(i) / static_cast<float>(cells.x),
                        t = static_cast<float>(j) / static_cast<float>(cells.y);
            const glm::vec2 turn = sin_cos_turns(i == cells.x ? 0.0f : s);
            const bool pole = j == 0 || j == cells.y;
            const glm::vec2 tilt =
                pole ? glm::vec2{0.0f, j == 0 ? -1.0f : 1.0f} : sin_cos_turns(0.5f * t - 0.25f);
            const glm::vec3 n{tilt.x * turn.x, tilt.y, -tilt.x * turn.y};
            b.vertex(centre + radius * n, n, {s * around, 0.5f * t * around});
        }
    const auto columns = static_cast<std::uint32_t>(cells.x + 1);
    for (int j = 0; j < cells.y; ++j)
        for (int i = 0; i < cells.x; ++i) {
            const std::uint32_t at =
                first + static_cast<std::uint32_t>(j) * columns + static_cast<std::uint32_t>(i);
            b.quad(at, at + 1, at + 1 + columns, at + columns, finish.material);
        }
}

} // namespace macula::scene::procedural
