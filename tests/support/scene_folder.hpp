// A temporary folder of scene files for one test, and how loading one of them went.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "scenes/load.hpp"

namespace macula::scene {

class SceneFolder : public testing::Test {
  protected:
    SceneFolder() {
        std::string pattern =
            (std::filesystem::temp_directory_path() / "macula scene XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr)
            throw std::runtime_error("no temporary folder " + pattern);
        folder_ = pattern; // with a blank in its name, as users have them
    }
    ~SceneFolder() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    void write(const std::string& name, const std::string& bytes) const {
        const std::filesystem::path file = folder_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }

    Scene load_written(const std::string& name, const LoadOptions& options = {}) const {
        return load(path(name), options);
    }

    // Writes and loads `bytes`.
    Scene load_text(const std::string& name, const std::string& bytes) const {
        write(name, bytes);
        return load_written(name);
    }

    // The message with which loading fails; a test failure when it does not.
    std::string error_of(const std::string& name, const LoadOptions& options = {}) const {
        try {
            load(path(name), options);
        } catch (const SceneError& error) {
            return error.what();
        }
        ADD_FAILURE() << name << " was loaded";
        return {};
    }
    std::string error_of_text(const std::string& name, const std::string& bytes) const {
        write(name, bytes);
        return error_of(name);
    }

    static bool warns(const Scene& scene, const std::string& part) {
        for (const std::string& warning : scene.warnings)
            if (warning.find(part) != std::string::npos)
                return true;
        return false;
    }

    std::filesystem::path folder_;
};

} // namespace macula::scene
