// Files of pictures in a folder that goes away with the test.
#pragma once

#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "host/metric/temporal.hpp"
#include "host/output/image.hpp"

namespace macula::test {

class PictureFiles : public ::testing::Test {
  protected:
    PictureFiles() {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::path(::testing::TempDir()) /
                  (std::string("macula_pictures_") + info->name());
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    ~PictureFiles() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) const {
        const std::filesystem::path file = folder_ / name;
        std::filesystem::create_directories(file.parent_path());
        return file.string();
    }
    void write_bytes(const std::string& name, const std::string& bytes) const {
        std::ofstream(path(name), std::ios::binary) << bytes;
    }
    std::string bytes_of(const std::string& name) const {
        std::ifstream file(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    // Leaves the first part of the file.
    void truncate(const std::string& name, double part) const {
        const std::string bytes = bytes_of(name);
        write_bytes(name, bytes.substr(0, static_cast<std::size_t>(
                                              part * static_cast<double>(bytes.size()))));
    }

    void write_png(const std::string& name, const metric::Picture& picture) const {
        output::write_png(path(name), picture.width, picture.height, picture.rgb, 3, 1.0f, {});
    }
    void write_exr(const std::string& name, const metric::Picture& picture,
                   const metric::MotionField* motion = nullptr,
                   const std::vector<std::string>& channels = {"R", "G", "B"}) const {
        const std::vector<std::uint32_t> colour = words_of(picture.rgb);
        std::vector<std::uint32_t> moves;
        std::vector<output::Layer> layers = {{channels, colour, 3, false}};
        if (motion != nullptr) {
            moves = words_of(motion->xy);
            layers.push_back({{"Motion.X", "Motion.Y"}, moves, 2, false});
        }
        output::write_exr(path(name), picture.width, picture.height, layers, {});
    }

    static std::vector<std::uint32_t> words_of(const std::vector<float>& values) {
        std::vector<std::uint32_t> words;
        for (const float value : values)
            words.push_back(std::bit_cast<std::uint32_t>(value));
        return words;
    }

    std::filesystem::path folder_;
};

} // namespace macula::test
