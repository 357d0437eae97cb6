/// Kernel source: the embedded files, overlaid by a folder, with #include expanded.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace macula::kernel {

struct SourceFile {
    /// Below kernels/, normalised.
    std::string path;
    std::string text;
    /// What compiler messages call it: the path below kernels/, or an overlay's full path.
    std::string display;
};

class Sources {
  public:
    /// `overlay`: a folder laid out as kernels/, whose files replace the embedded ones and are read
    /// on each use; empty for none. Throws Error when it is not a folder.
    explicit Sources(std::filesystem::path overlay = {});

    /// The text of `program`.cl with every `#include "path"` (below kernels/, or else beside the
    /// including file) replaced by the file, and #line directives that keep messages true. Throws
    /// compute::Error that names file and line for a missing file or a cycle.
    std::string expand(const std::string& program) const;

    /// Paths of all .cl files without ".cl", sorted, the overlay's included.
    std::vector<std::string> programs() const;

  private:
    /// Sets text and display; `path` is left alone.
    bool find(const std::string& path, SourceFile& file) const;
    SourceFile find_included(const std::string& include, const std::string& includer,
                             const std::string& place, const std::vector<std::string>& stack) const;
    void append(const SourceFile& file, std::vector<std::string>& stack, std::string& out) const;

    std::filesystem::path overlay_;
};

} // namespace macula::kernel
