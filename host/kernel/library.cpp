#include "host/kernel/library.hpp"

#include "host/kernel/program_cache.hpp"
#include "host/kernel/source.hpp"

#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace macula::kernel {
namespace {

/// Everything that a binary depends on.
std::string full_key(const std::string& source, const std::string& options,
                     const compute::DeviceFacts& device) {
    std::string key = "macula " MACULA_VERSION;
    for (const std::string& part : {device.platform_name, device.platform_version, device.name,
                                    device.version, device.driver_version, options, source})
        key += '\n' + part;
    return key;
}

void require_used(const VariantKey& key, const std::string& source) {
    for (const auto& [name, value] : key.values())
        if (source.find(VariantKey::macro_name(name)) == std::string::npos)
            throw compute::Error("kernel program " + key.text() + " has no parameter \"" + name +
                                 "\": " + VariantKey::macro_name(name) +
                                 " does not occur in its source");
}

} // namespace

LibraryOptions LibraryOptions::from_environment() {
    LibraryOptions options;
    if (const char* folder = std::getenv("MACULA_KERNEL_DIR"))
        options.overlay = folder;
    options.cache = ProgramCache::default_folder();
    return options;
}

struct Library::State {
    explicit State(const LibraryOptions& options)
        : sources(options.overlay), cache(options.cache) {}

    using Key = std::pair<const void*, std::string>;

    Sources sources;
    ProgramCache cache;
    mutable std::mutex mutex;
    /// Programs hold their device open, so that a device's id is never given to another.
    std::map<Key, compute::Program> programs;
    LibraryStatistics statistics;

    const compute::Program& program(const VariantKey& key, const compute::Device& device);
    compute::Program build(const VariantKey& key, const std::string& source,
                           const std::string& options, const compute::Device& device);
    std::optional<compute::Program> load(const std::string& cache_key, const std::string& options,
                                         const std::string& what, const compute::Device& device);
};

std::optional<compute::Program> Library::State::load(const std::string& cache_key,
                                                     const std::string& options,
                                                     const std::string& what,
                                                     const compute::Device& device) {
    const auto binary = cache.load(cache_key);
    if (!binary)
        return std::nullopt;
    try {
        return device.load(*binary, options, what);
    } catch (const compute::Error&) {
        // A driver may refuse a binary of its own, e.g. after an update that kept its version.
        return std::nullopt;
    }
}

compute::Program Library::State::build(const VariantKey& key, const std::string& source,
                                       const std::string& options, const compute::Device& device) {
    const std::string what = "kernel program " + key.text();
    const std::string cache_key = full_key(source, options, device.facts());
    if (auto loaded = load(cache_key, options, what, device)) {
        ++statistics.loaded_from_disk;
        return *loaded;
    }
    compute::Program program = device.build(source, options, what);
    ++statistics.compiled;
    cache.store(cache_key, program.binary());
    return program;
}

const compute::Program& Library::State::program(const VariantKey& key,
                                                const compute::Device& device) {
    const Key index(device.id(), key.text());
    const auto found = programs.find(index);
    if (found != programs.end()) {
        ++statistics.reused;
        return found->second;
    }
    const std::string source = sources.expand(key.program());
    require_used(key, source);
    compute::Program built = build(key, source, build_options(key, device.facts()), device);
    return programs.emplace(index, std::move(built)).first->second;
}

Library::Library(const LibraryOptions& options) : state_(std::make_unique<State>(options)) {}

Library::~Library() = default;

compute::Kernel Library::kernel(const VariantKey& key, const std::string& entry,
                                const compute::Device& device) {
    const std::lock_guard lock(state_->mutex);
    return state_->program(key, device).kernel(entry);
}

std::string Library::source(const std::string& program) const {
    return state_->sources.expand(program);
}

std::vector<std::string> Library::programs() const {
    return state_->sources.programs();
}

std::string Library::build_options(const VariantKey& key, const compute::DeviceFacts& device) {
    std::string options = "-cl-std=CL1.2";
    if (device.fp32.correctly_rounded_divide_sqrt)
        options += " -cl-fp32-correctly-rounded-divide-sqrt -DMACULA_CORRECTLY_ROUNDED=1";
    else
        options += " -DMACULA_CORRECTLY_ROUNDED=0";
    const std::string defines = key.options();
    return defines.empty() ? options : options + " " + defines;
}

LibraryStatistics Library::statistics() const {
    const std::lock_guard lock(state_->mutex);
    return state_->statistics;
}

} // namespace macula::kernel
