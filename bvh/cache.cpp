// The disk cache of trees: one file a geometry, named by its key.
#include "bvh/bvh.hpp"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <xxhash.h>

namespace macula::bvh {
namespace {

namespace fs = std::filesystem;

constexpr char kMagic[8] = {'M', 'A', 'C', 'U', 'L', 'A', 'B', 'V'};
// Raised by every change to the builder or to TreeNode: an older file is then stale.
constexpr std::uint32_t kVersion = 3;

struct Key {
    std::uint64_t low = 0, high = 0;
    bool operator==(const Key&) const = default;
};

struct Header {
    char magic[8];
    std::uint32_t version, node_bytes;
    Key key;
    std::uint64_t nodes;
    std::uint64_t references;
    std::uint64_t checksum; // XXH3 of the nodes, seeded with the references
};
static_assert(sizeof(Header) == 56 && std::is_trivially_copyable_v<TreeNode>);

template <class T>
void digest(XXH3_state_t& state, std::span<const T> values) {
    const std::uint64_t count = values.size();
    XXH3_128bits_update(&state, &count, sizeof count);
    XXH3_128bits_update(&state, values.data(), values.size_bytes());
}

// Of everything that decides the tree; the number of threads does not.
Key key_of(const Geometry& geometry, const BuildOptions& options) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         XXH3_freeState);
    XXH3_128bits_reset(state.get());
    digest(*state, geometry.positions);
    digest(*state, geometry.triangles);
    const float numbers[] = {options.overlap_threshold, options.duplication_budget,
                             options.traversal_cost, options.intersection_cost};
    const std::uint32_t words[] = {kVersion, options.spatial_splits ? 1u : 0u, options.bins};
    digest(*state, std::span<const float>(numbers));
    digest(*state, std::span<const std::uint32_t>(words));
    const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
    return {hash.low64, hash.high64};
}

// A file mapped for reading; empty when there is none.
class MappedFile {
  public:
    explicit MappedFile(const fs::path& path) {
        const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0)
            return;
        struct stat facts {};
        if (fstat(file, &facts) == 0 && S_ISREG(facts.st_mode)) {
            exists_ = true;
            size_ = static_cast<std::size_t>(facts.st_size);
            void* data =
                size_ == 0 ? nullptr : mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
            data_ = data == MAP_FAILED ? nullptr : static_cast<const std::byte*>(data);
        }
        close(file);
    }
    ~MappedFile() {
        if (data_ != nullptr)
            munmap(const_cast<std::byte*>(data_), size_);
    }
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    bool exists() const { return exists_; }
    std::span<const std::byte> bytes() const { return {data_, data_ == nullptr ? 0 : size_}; }

  private:
    bool exists_ = false;
    std::size_t size_ = 0;
    const std::byte* data_ = nullptr;
};

// What is wrong with the file; empty when it holds the tree of `key`.
std::string fault_of(std::span<const std::byte> bytes, const Key& key) {
    if (bytes.size() < sizeof(Header))
        return "truncated";
    Header header;
    std::memcpy(&header, bytes.data(), sizeof header);
    if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0)
        return "not a BVH cache file";
    if (header.version != kVersion || header.node_bytes != sizeof(TreeNode))
        return "of another version";
    if (!(header.key == key))
        return "of another geometry";
    const std::span<const std::byte> nodes = bytes.subspan(sizeof(Header));
    if (header.nodes != nodes.size() / sizeof(TreeNode) || nodes.size() % sizeof(TreeNode) != 0)
        return "truncated";
    if (XXH3_64bits_withSeed(nodes.data(), nodes.size(), header.references) != header.checksum)
        return "corrupted";
    return "";
}

Tree read_tree(std::span<const std::byte> bytes) {
    Header header;
    std::memcpy(&header, bytes.data(), sizeof header);
    Tree tree;
    tree.references = static_cast<std::uint32_t>(header.references);
    tree.nodes.resize(header.nodes);
    if (!tree.nodes.empty())
        std::memcpy(tree.nodes.data(), bytes.data() + sizeof header,
                    tree.nodes.size() * sizeof(TreeNode));
    return tree;
}

// Whole or not at all: written beside its place, then renamed. Returns the cause of a failure.
std::string write_tree(const fs::path& path, const Key& key, const Tree& tree) {
    Header header{};
    std::memcpy(header.magic, kMagic, sizeof kMagic);
    header.version = kVersion;
    header.node_bytes = sizeof(TreeNode);
    header.key = key;
    header.nodes = tree.nodes.size();
    header.references = tree.references;
    header.checksum = XXH3_64bits_withSeed(tree.nodes.data(), tree.nodes.size() * sizeof(TreeNode),
                                           header.references);
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    const fs::path partial = path.string() + ".partial-" + std::to_string(getpid());
    std::FILE* file = std::fopen(partial.c_str(), "wb");
    if (file == nullptr)
        return std::strerror(errno);
    const bool written = std::fwrite(&header, sizeof header, 1, file) == 1 &&
                         std::fwrite(tree.nodes.data(), sizeof(TreeNode), tree.nodes.size(),
                                     file) == tree.nodes.size();
    const bool closed = std::fclose(file) == 0;
    if (written && closed)
        fs::rename(partial, path, error);
    if (!written || !closed || error) {
        const std::string cause = error ? error.message() : std::strerror(errno);
        fs::remove(partial, error);
        return cause;
    }
    return "";
}

} // namespace

CacheResult build_cached(const Geometry& geometry, const BuildOptions& options,
                         const fs::path& directory) {
    if (directory.empty())
        return {build(geometry, options), false, ""};
    const auto start = std::chrono::steady_clock::now();
    const Key key = key_of(geometry, options);
    char name[48];
    std::snprintf(name, sizeof name, "%016llx%016llx.bvh",
                  static_cast<unsigned long long>(key.high),
                  static_cast<unsigned long long>(key.low));
    const fs::path path = directory / name;
    CacheResult result;
    {
        const MappedFile file(path);
        const std::string fault = file.exists() ? fault_of(file.bytes(), key) : "";
        if (file.exists() && fault.empty()) {
            result.tree = read_tree(file.bytes());
            result.from_cache = true;
            result.tree.build_seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            return result;
        }
        if (!fault.empty())
            result.note = "cache file '" + path.string() + "' is " + fault + "; built anew";
    }
    result.tree = build(geometry, options);
    const std::string cause = write_tree(path, key, result.tree);
    if (!cause.empty())
        result.note = "writing cache file '" + path.string() + "': " + cause;
    return result;
}

} // namespace macula::bvh
