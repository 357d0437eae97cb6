#include "host/kernel/library.hpp"
#include "host/kernel/program_cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdlib.h>

#include <fstream>
#include <iterator>

namespace {

using namespace macula;
using kernel::Library;
using kernel::VariantKey;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

constexpr const char* kGood = R"(#include "test/number.h"
kernel void store(global uint *out) {
    *out = NUMBER + MACULA_EXTRA;
}
)";

class LibraryTest : public testing::Test {
  protected:
    LibraryTest() {
        std::string pattern = (fs::temp_directory_path() / "macula_library_XXXXXX").string();
        folder = mkdtemp(pattern.data());
        options.overlay = folder / "kernels";
        options.cache = folder / "cache";
        fs::create_directories(options.overlay);
        write("test/number.h", "#define NUMBER 40u\n");
        write("test/good.cl", kGood);
    }
    ~LibraryTest() override { fs::remove_all(folder); }

    void write(const std::string& path, const std::string& text) const {
        fs::create_directories((options.overlay / path).parent_path());
        std::ofstream(options.overlay / path) << text;
    }
    std::uint32_t run_good(Library& library, int extra = 2) const {
        const compute::Buffer out = device.allocate(4, "result");
        library.kernel(VariantKey("test/good").parameter("extra", extra), "store", device)
            .set(out)
            .launch("store", {1});
        return out.read_one<std::uint32_t>();
    }
    fs::path cache_file() const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::recursive_directory_iterator(options.cache))
            if (entry.is_regular_file())
                files.push_back(entry.path());
        EXPECT_EQ(files.size(), 1u);
        return files.empty() ? fs::path() : files.front();
    }

    fs::path folder;
    kernel::LibraryOptions options;
    compute::Device device = compute::open();
};

TEST_F(LibraryTest, ProgramIsCompiledOnceThenReusedThenLoadedFromDisk) {
    {
        Library library(options);
        EXPECT_EQ(run_good(library), 42u);
        EXPECT_EQ(run_good(library), 42u);
        EXPECT_EQ(library.statistics().compiled, 1u);
        EXPECT_EQ(library.statistics().reused, 1u);
    }
    Library library(options);
    EXPECT_EQ(run_good(library), 42u);
    EXPECT_EQ(library.statistics().compiled, 0u);
    EXPECT_EQ(library.statistics().loaded_from_disk, 1u);
}

TEST_F(LibraryTest, CorruptedCacheFilesAreCompiledAnew) {
    {
        Library library(options);
        run_good(library);
    }
    const fs::path file = cache_file();
    std::ifstream in(file, std::ios::binary);
    const std::string whole(std::istreambuf_iterator<char>(in), {});
    std::string flipped = whole;
    flipped[whole.size() - 100] = static_cast<char>(flipped[whole.size() - 100] ^ 1);
    for (const std::string& text : {flipped, whole.substr(0, whole.size() / 2), std::string(),
                                    std::string("MACULAP1"), whole + "x"}) {
        std::ofstream(file, std::ios::binary) << text;
        Library library(options);
        EXPECT_EQ(run_good(library), 42u);
        EXPECT_EQ(library.statistics().compiled, 1u);
        Library again(options);
        EXPECT_EQ(run_good(again), 42u);
        EXPECT_EQ(again.statistics().loaded_from_disk, 1u) << "the cache was not repaired";
    }
}

TEST_F(LibraryTest, ChangedHeaderOrParameterIsAnotherProgram) {
    Library first(options);
    EXPECT_EQ(run_good(first, 2), 42u);
    EXPECT_EQ(run_good(first, 3), 43u);
    write("test/number.h", "#define NUMBER 50u\n");
    Library second(options);
    EXPECT_EQ(run_good(second, 2), 52u);
    EXPECT_EQ(second.statistics().compiled, 1u);
}

TEST_F(LibraryTest, UnwritableCacheOnlyCostsTime) {
    options.cache = "/proc/nosuch/cache";
    Library library(options);
    EXPECT_EQ(run_good(library), 42u);
}

TEST_F(LibraryTest, TwoOpenDevicesHaveProgramsOfTheirOwn) {
    Library library(options);
    EXPECT_EQ(run_good(library), 42u);
    device = compute::open();
    EXPECT_EQ(run_good(library), 42u);
    EXPECT_EQ(library.statistics().reused, 0u);
}

TEST_F(LibraryTest, BrokenKernelNamesFileLineVariantAndDevice) {
    write("test/good.cl", "#include \"test/number.h\"\nkernel void store(global uint *out) {\n"
                          "    *out = undeclared_name + MACULA_EXTRA;\n}\n");
    Library library(options);
    const std::string place = (options.overlay / "test/good.cl").string() + ":3";
    EXPECT_THAT([&] { run_good(library); },
                ThrowsMessage<compute::BuildError>(
                    AllOf(HasSubstr(place), HasSubstr("undeclared_name"),
                          HasSubstr("test/good [extra=2]"), HasSubstr(device.facts().name))));
}

TEST_F(LibraryTest, ErrorInAHeaderNamesTheHeader) {
    write("test/number.h", "\n#error the number is missing\n");
    Library library(options);
    EXPECT_THAT([&] { run_good(library); },
                ThrowsMessage<compute::BuildError>(
                    HasSubstr((options.overlay / "test/number.h").string() + ":2")));
}

TEST_F(LibraryTest, BrokenEmbeddedIncludeNamesThePathBelowKernels) {
    write("test/good.cl", "#include \"shared/language.h\"\n#include \"test/missing.h\"\n");
    Library library(options);
    EXPECT_THAT([&] { run_good(library); }, ThrowsMessage<compute::Error>(AllOf(
                                                HasSubstr("good.cl:2"), HasSubstr("no kernel file"),
                                                HasSubstr("test/missing.h"))));
}

TEST_F(LibraryTest, IncludeBesideTheIncludingFile) {
    write("test/good.cl", std::string(kGood).replace(0, 24, "#include \"number.h\"     "));
    Library library(options);
    EXPECT_EQ(run_good(library), 42u);
}

TEST_F(LibraryTest, CycleOfIncludesIsAnError) {
    write("test/number.h", "#include \"./../test/number.h\"\n");
    Library library(options);
    EXPECT_THAT([&] { run_good(library); },
                ThrowsMessage<compute::Error>(HasSubstr("includes itself")));
}

TEST_F(LibraryTest, OverlayReplacesAnEmbeddedFileAndTheRestStays) {
    write("scan/scan.cl", "kernel void nothing(global int *x) {}\n");
    const Library library(options);
    EXPECT_THAT(library.source("scan/scan"), HasSubstr("void nothing"));
    EXPECT_THAT(library.programs(), testing::IsSupersetOf({"scan/scan", "test/good"}));
}

TEST_F(LibraryTest, OverlayComesFromTheEnvironment) {
    setenv("MACULA_KERNEL_DIR", options.overlay.c_str(), 1);
    setenv("MACULA_CACHE_DIR", options.cache.c_str(), 1);
    Library library;
    unsetenv("MACULA_KERNEL_DIR");
    unsetenv("MACULA_CACHE_DIR");
    EXPECT_EQ(run_good(library), 42u);
    EXPECT_FALSE(cache_file().empty());
}

TEST_F(LibraryTest, MissingOverlayFolderIsAnError) {
    options.overlay = folder / "nosuch";
    EXPECT_THAT([&] { Library library(options); },
                ThrowsMessage<compute::Error>(HasSubstr("MACULA_KERNEL_DIR")));
}

TEST_F(LibraryTest, UnknownProgramAndUnusedParameterAreErrors) {
    Library library(options);
    EXPECT_THAT([&] { library.kernel(VariantKey("test/nosuch"), "store", device); },
                ThrowsMessage<compute::Error>(HasSubstr("\"test/nosuch\"")));
    EXPECT_THAT(
        [&] {
            library.kernel(VariantKey("test/good").parameter("extra", 1).parameter("extar", 1),
                           "store", device);
        },
        ThrowsMessage<compute::Error>(AllOf(HasSubstr("\"extar\""), HasSubstr("MACULA_EXTAR"))));
}

TEST(VariantKeyTest, OrderOfCallsDoesNotMatter) {
    const auto one = VariantKey("a/b").any_hit(true).parameter("work_group", 64);
    const auto two = VariantKey("a/b").parameter("work_group", 64).any_hit(true);
    EXPECT_EQ(one, two);
    EXPECT_EQ(one.options(), "-DMACULA_ANY_HIT=1 -DMACULA_WORK_GROUP=64");
    EXPECT_EQ(one.text(), "a/b [any_hit=1 work_group=64]");
}

TEST(VariantKeyTest, NamesAreChecked) {
    for (const char* name : {"", "Upper", "1st", "a-b", "x=1 -cl-fast-relaxed-math", "masks"})
        EXPECT_THROW(VariantKey("a/b").parameter(name, 1), std::invalid_argument) << name;
}

TEST(BuildOptions, CorrectRoundingWhereTheDeviceHasItAndNeverRelaxedMath) {
    compute::DeviceFacts facts;
    EXPECT_EQ(Library::build_options(VariantKey("a"), facts),
              "-cl-std=CL1.2 -DMACULA_CORRECTLY_ROUNDED=0");
    facts.fp32.correctly_rounded_divide_sqrt = true;
    EXPECT_EQ(Library::build_options(VariantKey("a").masks(false), facts),
              "-cl-std=CL1.2 -cl-fp32-correctly-rounded-divide-sqrt -DMACULA_CORRECTLY_ROUNDED=1 "
              "-DMACULA_MASKS=0");
}

TEST(EmbeddedKernels, EveryProgramExpands) {
    kernel::LibraryOptions options;
    const Library library(options);
    ASSERT_FALSE(library.programs().empty());
    for (const std::string& program : library.programs())
        EXPECT_THAT(library.source(program), Not(testing::ContainsRegex("\n *#include \"")))
            << program;
}

} // namespace
