#include "scenes/input.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <memory>

#include <zlib.h>
#include <zstd.h>

#include "scenes/error.hpp"

namespace macula::scene {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20;

[[noreturn]] void fail_too_large(const std::string& name, std::uint64_t max_bytes) {
    throw SceneError(name + ": unpacks to more than the limit of " + std::to_string(max_bytes) +
                     " bytes");
}

// Makes room for the next chunk of output, at most one byte beyond the limit, so that reaching
// the limit exactly is told from passing it.
std::size_t grow(std::string& out, std::uint64_t max_bytes) {
    const std::uint64_t room = max_bytes + 1 - out.size();
    const std::size_t step = static_cast<std::size_t>(
        std::min<std::uint64_t>(room, std::max<std::size_t>(kChunk, out.size() / 2)));
    out.resize(out.size() + step);
    return step;
}

std::string decompress_zstd(std::string_view data, std::uint64_t max_bytes,
                            const std::string& name) {
    const unsigned long long announced = ZSTD_getFrameContentSize(data.data(), data.size());
    if (announced == ZSTD_CONTENTSIZE_ERROR)
        throw SceneError(name + ": not Zstandard data");
    const bool known = announced != ZSTD_CONTENTSIZE_UNKNOWN;
    if (known && announced > max_bytes)
        fail_too_large(name, max_bytes);
    const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                            &ZSTD_freeDStream);
    if (!stream)
        throw SceneError(name + ": cannot start Zstandard decompression");
    ZSTD_inBuffer in{data.data(), data.size(), 0};
    std::string out;
    std::size_t used = 0, remaining = 1;
    while (in.pos < in.size || remaining != 0) {
        if (used == out.size())
            grow(out, max_bytes);
        ZSTD_outBuffer chunk{out.data() + used, out.size() - used, 0};
        const std::size_t before = in.pos;
        remaining = ZSTD_decompressStream(stream.get(), &chunk, &in);
        if (ZSTD_isError(remaining))
            throw SceneError(name + ": damaged Zstandard data: " + ZSTD_getErrorName(remaining));
        used += chunk.pos;
        if (used > max_bytes)
            fail_too_large(name, max_bytes);
        if (chunk.pos == 0 && in.pos == before && in.pos == in.size && remaining != 0)
            throw SceneError(name + ": Zstandard data end early");
    }
    out.resize(used);
    return out;
}

std::string decompress_gzip(std::string_view data, std::uint64_t max_bytes,
                            const std::string& name) {
    z_stream stream{};
    if (inflateInit2(&stream, 15 + 16) != Z_OK)
        throw SceneError(name + ": cannot start gzip decompression");
    const std::unique_ptr<z_stream, decltype(&inflateEnd)> guard(&stream, &inflateEnd);
    std::string out;
    std::size_t used = 0, consumed = 0;
    bool finished = false; // at the end of a member; another one may follow
    while (!finished || consumed < data.size()) {
        if (finished && inflateReset(&stream) != Z_OK)
            throw SceneError(name + ": cannot restart gzip decompression");
        if (used == out.size())
            grow(out, max_bytes);
        const std::size_t input = std::min(data.size() - consumed, kChunk);
        const std::size_t output = std::min(out.size() - used, kChunk);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data() + consumed));
        stream.avail_in = static_cast<uInt>(input);
        stream.next_out = reinterpret_cast<Bytef*>(out.data() + used);
        stream.avail_out = static_cast<uInt>(output);
        const int status = inflate(&stream, Z_NO_FLUSH);
        const std::size_t read = input - stream.avail_in, written = output - stream.avail_out;
        consumed += read;
        used += written;
        if (used > max_bytes)
            fail_too_large(name, max_bytes);
        finished = status == Z_STREAM_END;
        if (status == Z_BUF_ERROR || (status == Z_OK && read == 0 && written == 0))
            throw SceneError(name + ": gzip data end early");
        if (status != Z_OK && status != Z_STREAM_END)
            throw SceneError(name + ": damaged gzip data" +
                             (stream.msg ? std::string(": ") + stream.msg : std::string()));
    }
    out.resize(used);
    return out;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// The entry of `folder` called `name` in any case; empty when there is none.
std::filesystem::path find_entry(const std::filesystem::path& folder, const std::string& name) {
    std::error_code error;
    std::filesystem::path found;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::filesystem::path& path = entry->path();
        if (lower(path.filename().string()) == lower(name) && (found.empty() || path < found))
            found = path;
    }
    return found;
}

} // namespace

Compression compression_of(const std::filesystem::path& path) {
    const std::string extension = lower(path.extension().string());
    if (extension == ".gz")
        return Compression::gzip;
    return extension == ".zst" ? Compression::zstd : Compression::none;
}

std::filesystem::path without_compression(const std::filesystem::path& path) {
    return compression_of(path) == Compression::none ? path : path.parent_path() / path.stem();
}

std::string decompress(std::string_view data, Compression compression, std::uint64_t max_bytes,
                       const std::string& name) {
    if (compression != Compression::none && data.empty())
        throw SceneError(name + ": the file is empty");
    if (compression == Compression::zstd)
        return decompress_zstd(data, max_bytes, name);
    if (compression == Compression::gzip)
        return decompress_gzip(data, max_bytes, name);
    if (data.size() > max_bytes)
        fail_too_large(name, max_bytes);
    return std::string(data);
}

std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    const std::string name = path.string();
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
        throw SceneError(name + ": no such file");
    if (std::filesystem::is_directory(status))
        throw SceneError(name + ": is a directory, a file was expected");
    if (!std::filesystem::is_regular_file(status))
        throw SceneError(name + ": is not a regular file");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error)
        throw SceneError(name + ": " + error.message());
    if (size > max_bytes)
        throw SceneError(name + ": " + std::to_string(size) + " bytes are more than the limit of " +
                         std::to_string(max_bytes));
    std::ifstream file(path, std::ios::binary);
    std::string bytes(static_cast<std::size_t>(size), '\0');
    if (!file || !file.read(bytes.data(), static_cast<std::streamsize>(size)))
        throw SceneError(name + ": cannot be read");
    const Compression compression = compression_of(path);
    return compression == Compression::none ? bytes
                                            : decompress(bytes, compression, max_bytes, name);
}

std::filesystem::path path_below(const std::filesystem::path& folder, std::string reference) {
    std::replace(reference.begin(), reference.end(), '\\', '/');
    const bool drive = reference.size() > 1 && reference[1] == ':';
    if (reference.empty() || reference.front() == '/' || drive ||
        reference.find('\0') != std::string::npos)
        return {};
    const std::filesystem::path relative = std::filesystem::path(reference).lexically_normal();
    if (relative.empty() || *relative.begin() == "..")
        return {};
    return folder / relative;
}

std::filesystem::path existing_path_below(const std::filesystem::path& folder,
                                          const std::string& reference) {
    std::filesystem::path exact = path_below(folder, reference);
    std::error_code error;
    if (exact.empty() || std::filesystem::exists(exact, error))
        return exact;
    std::filesystem::path found = folder.empty() ? std::filesystem::path(".") : folder;
    for (const std::filesystem::path& part : path_below({}, reference)) {
        const std::filesystem::path here = found / part;
        found = std::filesystem::exists(here, error) ? here : find_entry(found, part.string());
        if (found.empty())
            return exact;
    }
    return found;
}

} // namespace macula::scene
