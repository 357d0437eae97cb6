/// All kernels, built on demand: embedded source, optional overlay, caches in the process and on
/// disk. Options are always -cl-std=CL1.2, correctly rounded division and square root where the
/// device has them, and the key's defines; never a relaxed-math option.
#pragma once

#include "host/cl/device.hpp"
#include "host/kernel/variant_key.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace macula::kernel {

struct LibraryOptions {
    /// Folder whose files replace the embedded kernels; empty: none.
    std::filesystem::path overlay;
    /// Folder of the program cache; empty: no cache on disk.
    std::filesystem::path cache;

    /// MACULA_KERNEL_DIR, and the cache folder of ProgramCache::default_folder().
    static LibraryOptions from_environment();
};

/// How programs were come by since the library was made.
struct LibraryStatistics {
    std::uint64_t compiled = 0;
    std::uint64_t loaded_from_disk = 0;
    std::uint64_t reused = 0;
};

/// Safe to use from several threads.
class Library {
  public:
    explicit Library(const LibraryOptions& options = LibraryOptions::from_environment());
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    /// A fresh kernel object for the function `entry`, e.g. "trace". Throws compute::BuildError
    /// that names the variant, the device and the compiler's log, or compute::Error for a program,
    /// entry or parameter that does not exist.
    compute::Kernel kernel(const VariantKey& key, const std::string& entry,
                           const compute::Device& device);

    /// Source of a program after includes, as the compiler sees it.
    std::string source(const std::string& program) const;
    /// All programs, e.g. "traverse/wide8", sorted.
    std::vector<std::string> programs() const;
    /// The complete build options of a key on a device.
    static std::string build_options(const VariantKey& key, const compute::DeviceFacts& device);

    LibraryStatistics statistics() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace macula::kernel
