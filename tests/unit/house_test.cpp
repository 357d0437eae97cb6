// The house rules that a compiler does not check: which folder may include which (ARCHITECTURE.md),
// and what kernels may not call (docs/arithmetic.md).
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {
namespace fs = std::filesystem;

const fs::path kRoot = MACULA_SOURCE_DIR;

std::string text_of(const fs::path& path) {
    std::ifstream in(path);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<fs::path> files_below(const std::string& folder, const std::set<std::string>& endings) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
        if (entry.is_regular_file() && endings.contains(entry.path().extension().string()))
            found.push_back(entry.path());
    }
    return found;
}

// Comments and string literals blanked, line structure kept.
std::string code_of(const std::string& text) {
    static const std::regex comment(R"(//[^\n]*|/\*[^]*?\*/|"(\\.|[^"\\\n])*")");
    std::string code = text;
    for (std::sregex_iterator it(text.begin(), text.end(), comment), end; it != end; ++it) {
        for (auto i = it->position(); i < it->position() + it->length(); ++i) {
            if (code[static_cast<std::size_t>(i)] != '\n')
                code[static_cast<std::size_t>(i)] = ' ';
        }
    }
    return code;
}

TEST(House, ArrowsPointOneWay) {
    // folder -> the project folders it may include besides itself
    const std::map<std::string, std::set<std::string>> allowed = {
        {"kernels/shared", {}},
        {"kernels/lib", {"shared"}},
        {"bvh", {"shared", "lib"}},
        {"scenes", {"shared", "lib", "bvh"}},
        {"host/cl", {"shared"}},
        {"host/kernel", {"shared", "bvh", "host/cl"}},
        {"host/frame", {"shared", "lib", "bvh", "scenes", "host/cl", "host/kernel"}},
        {"host/stage", {"shared", "lib", "bvh", "scenes", "host/cl", "host/kernel", "host/frame"}},
        {"host/metric", {"scenes"}},
        {"host/output", {"host/metric"}},
        {"host/method", {"shared", "scenes", "host/frame", "host/stage"}},
    };
    const std::regex include("#include \"((?:host/[a-z]+|[a-z]+))/");
    for (const auto& [folder, targets] : allowed) {
        for (const fs::path& path : files_below(folder, {".hpp", ".cpp", ".h"})) {
            const std::string text = text_of(path);
            for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
                const std::string target = (*it)[1];
                const bool own = folder == target || folder == "kernels/" + target;
                EXPECT_TRUE(own || targets.contains(target)) << path << " includes " << target;
            }
        }
    }
}

TEST(House, MethodsNameNoOpenClType) {
    const std::regex cl_type(R"(\bcl_\w+|\bcl::|CL/)");
    for (const fs::path& path : files_below("host/method", {".hpp", ".cpp"}))
        EXPECT_FALSE(std::regex_search(text_of(path), cl_type)) << path;
}

TEST(House, KernelsCallNothingThatRuntimesRoundDifferently) {
    const std::regex banned(
        R"(\b(mad|mad24|mix|dot|cross|length|distance|normalize|fast_\w+|native_\w+|half_(sin|cos|exp|log|pow|sqrt|rsqrt|divide)\w*|rsqrt|cbrt|hypot|exp10|expm1|log10|log1p|pow|pown|powr|rootn|sin|cos|tan|sincos|asin|acos|atan|atan2|sinh|cosh|tanh|sinpi|cospi|tanpi|erf|tgamma|lgamma|fmod|remainder|remquo|fmin|fmax|smoothstep|atomic_\w+_float|read_image\w+)\s*\()");
    for (const fs::path& path : files_below("kernels", {".cl", ".h"})) {
        std::istringstream lines(code_of(text_of(path)));
        int number = 0;
        for (std::string line; std::getline(lines, line);) {
            ++number;
            EXPECT_FALSE(std::regex_search(line, banned)) << path << ":" << number << ": " << line;
        }
    }
}

// Built-in division and square root are correctly rounded only where the device says so:
// kernels/lib/math*.h chooses.
TEST(House, KernelsDivideThroughTheMathLibrary) {
    const std::regex division(R"([\w)\]]\s*/\s*[\w(]|\bsqrt\s*\()");
    const std::regex of_integers(R"(\b(int|uint|Uint|size_t|u32)\b|[0-9]+u|MACULA_RAY_BLOCK|get_|/ [0-9]+\))");
    for (const fs::path& path : files_below("kernels", {".cl", ".h"})) {
        if (path.filename().string().starts_with("math"))
            continue;
        std::istringstream lines(code_of(text_of(path)));
        int number = 0;
        for (std::string line; std::getline(lines, line);) {
            ++number;
            if (line.find("#include") != std::string::npos || std::regex_search(line, of_integers))
                continue;
            EXPECT_FALSE(std::regex_search(line, division))
                << path << ":" << number << ": " << line;
        }
    }
}

TEST(House, RelaxedMathIsNeverAsked) {
    const std::regex relaxed(
        "\"[^\"\n]*-cl-(fast-relaxed-math|mad-enable|denorms-are-zero|unsafe-math|"
        "finite-math|no-signed)");
    for (const fs::path& path : files_below("host", {".hpp", ".cpp"}))
        EXPECT_FALSE(std::regex_search(text_of(path), relaxed)) << path;
}

TEST(House, SharedStructsUseFourByteScalarsOnly) {
    const std::regex banned(R"(\b(float3|float2|float4|bool|size_t|long|double|half)\b)");
    for (const fs::path& path : files_below("kernels/shared", {".h"})) {
        if (path.filename() == "language.h")
            continue;
        EXPECT_FALSE(std::regex_search(code_of(text_of(path)), banned)) << path;
    }
}

TEST(House, LinesFitInAHundredColumns) {
    for (const std::string folder : {"kernels", "bvh", "scenes", "host", "tests", "bench"}) {
        for (const fs::path& path : files_below(folder, {".cl", ".h", ".hpp", ".cpp"})) {
            std::istringstream lines(text_of(path));
            int number = 0;
            for (std::string line; std::getline(lines, line);) {
                ++number;
                EXPECT_TRUE(line.size() <= 100 || line.find("R\"(") != std::string::npos)
                    << path << ":" << number;
            }
        }
    }
}

} // namespace
