// Results of `macula bench quality` as lines and as a page: nothing is lost, nothing that comes
// from data becomes markup, what is wrong is named with file and line.
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/output/image.hpp"
#include "host/output/jpeg.hpp"
#include "host/report/data_uri.hpp"
#include "host/report/page.hpp"
#include "host/report/results_file.hpp"
#include "tests/support/quality_cases.hpp"

namespace {
using namespace macula;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kPng = "\x89PNG\r\n\x1a\nnot looked at any further";

class Report : public ::testing::Test {
  protected:
    Report() { std::filesystem::create_directories(folder_); }
    ~Report() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    // What reading the file, or making its page, complains about.
    template <class F>
    static std::string complaint(const F& action) {
        try {
            action();
        } catch (const std::exception& error) {
            return error.what();
        }
        return "nothing";
    }
    std::string complaint_of(const std::string& text) const {
        write("r.jsonl", text);
        return complaint([&] { report::read_results(folder_ / "r.jsonl"); });
    }
    std::string complaint_of_picture(const std::string& name) const {
        report::QualityCase c = test::quality_case();
        c.pictures = {{0, std::nullopt, name, name, name}};
        return complaint([&] { report::page({{folder_ / "r.jsonl", {c}}}, "title"); });
    }

    std::filesystem::path folder_ =
        std::filesystem::path(::testing::TempDir()) /
        (std::string("report_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Report, ALineComesBack) {
    report::QualityCase c = test::quality_case();
    c.pictures = {{501, std::array{12.5, 20.0}, "a.png", "b.png", "c.png"}};
    const std::string line = json_line(c);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_EQ(json_line(report::parse_case(line)), line);
}

TEST_F(Report, TheIdentityIsWhatWasAskedForAndNotWhatWasFound) {
    const report::QualityCase c = test::quality_case();
    report::QualityCase found = c;
    found.time_ms.median = 77.0;
    found.commit = "another";
    EXPECT_EQ(identity(found), identity(c));
    report::QualityCase low = c;
    low.parameters.equal = "time";
    const std::string before = identity(low);
    low.parameters.scale = 0.3;
    EXPECT_EQ(identity(low), before);
    EXPECT_NE(before, identity(c));
    report::QualityCase other = c;
    other.seed = 1;
    EXPECT_NE(identity(other), identity(c));
}

TEST_F(Report, WhatIsNoFiniteNumberIsNotWritten) {
    report::QualityCase c = test::quality_case();
    c.scores.ssim = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(json_line(c), std::invalid_argument);
}

TEST_F(Report, ACutOffLastLineIsNamed) {
    const std::string line = json_line(test::quality_case());
    EXPECT_THAT(complaint_of(line + "\n" + line.substr(0, 100)),
                AllOf(HasSubstr("r.jsonl"), HasSubstr("line 2"), HasSubstr("cut off")));
    EXPECT_THAT(complaint_of(line), HasSubstr("line 1"));
    EXPECT_EQ(complaint_of(line + "\n"), "nothing");
}

TEST_F(Report, AWrongFieldIsNamedWithItsPlace) {
    const auto changed = [](const std::string& from, const std::string& to) {
        std::string line = json_line(test::quality_case());
        return line.replace(line.find(from), from.size(), to) + "\n";
    };
    EXPECT_THAT(complaint_of("\n" + changed("\"ssim\"", "\"sism\"")),
                AllOf(HasSubstr("line 2"), HasSubstr("scores.ssim"), HasSubstr("missing")));
    EXPECT_THAT(complaint_of(changed("\"width\":96", "\"width\":\"96\"")), HasSubstr("\"width\""));
    EXPECT_THAT(complaint_of(changed("\"width\":96", "\"width\":-1")), HasSubstr("\"width\""));
    EXPECT_THAT(complaint_of(changed("\"width\":96", "\"width\":99999")), HasSubstr("\"width\""));
    EXPECT_THAT(complaint_of(changed("\"median\":1.5", "\"median\":null")),
                HasSubstr("stages[0].median"));
    EXPECT_THAT(complaint_of(changed("\"schema\":1", "\"schema\":2")), HasSubstr("schema"));
    EXPECT_THAT(complaint_of(changed("[2.0,2.1,2.2]", "[2.0]")), HasSubstr("series"));
    EXPECT_THAT(complaint_of("[]\n"), HasSubstr("object"));
    EXPECT_THAT(complaint_of("{\"schema\":\n"), HasSubstr("line 1"));
    EXPECT_THAT(complaint_of(changed("a device", "a \xff device")), HasSubstr("line 1"));
    EXPECT_THAT(complaint_of(""), HasSubstr("no case"));
    EXPECT_THAT(complaint([&] { report::read_results(folder_ / "none"); }), HasSubstr("none"));
    EXPECT_THAT(complaint([&] { report::read_results(folder_); }), HasSubstr("folder"));
}

TEST_F(Report, DataNeverBecomesMarkup) {
    const std::string page =
        report::page({{folder_ / "r.jsonl", {test::quality_case()}}}, "<i>@RESULTS@ & \"title\"");
    EXPECT_THAT(page, Not(HasSubstr("<i>")));
    EXPECT_THAT(page, Not(HasSubstr("</script><b>")));
    EXPECT_THAT(page, HasSubstr("\\u003c/script>\\u003cb>"));
    EXPECT_THAT(page, HasSubstr("<h1>&#60;i&#62;@RESULTS@ &#38; &#34;title&#34;</h1>"));
    for (const char* outside : {"http://", "src=\"", "@import", "url("})
        EXPECT_THAT(page.substr(0, page.find("http://www.w3.org")), Not(HasSubstr(outside)));
}

TEST_F(Report, APictureIsInThePageOnceAndItsPathIsNot) {
    write("p.png", kPng);
    report::QualityCase c = test::quality_case();
    c.pictures = {{0, std::nullopt, "p.png", "p.png", "p.png"}};
    const std::string page = report::page({{folder_ / "r.jsonl", {c, c}}}, "title");
    const std::string uri = report::data_uri(kPng);
    EXPECT_THAT(uri, ::testing::StartsWith("data:image/png;base64,iVBORw0KGgp"));
    const auto first = page.find(uri);
    ASSERT_NE(first, std::string::npos);
    EXPECT_EQ(page.find(uri, first + 1), std::string::npos);
    EXPECT_THAT(page, Not(HasSubstr("p.png")));
}

TEST_F(Report, AWrongPictureIsNamed) {
    write("text.png", "no picture");
    EXPECT_THAT(complaint_of_picture("missing.png"),
                AllOf(HasSubstr("missing.png"), HasSubstr("cornell"), HasSubstr("No such file")));
    EXPECT_THAT(complaint_of_picture("text.png"), HasSubstr("neither PNG"));
    for (const char* outside : {"", "../p.png", "a/../../p.png", "/etc/hostname"})
        EXPECT_THAT(complaint_of_picture(outside), HasSubstr("below the folder")) << outside;
}

TEST_F(Report, APictureBecomesASmallJpegOfTheSameSize) {
    std::vector<float> rgb(3 * 64 * 48);
    for (std::size_t i = 0; i < rgb.size(); ++i)
        rgb[i] = static_cast<float>(i * 7919 % 256) / 255.0f;
    output::write_png(folder_ / "p.png", 64, 48, rgb, 3, 1.0f, {});
    const std::string high = output::as_jpeg(folder_ / "p.png", 100);
    const std::string low = output::as_jpeg(folder_ / "p.png", 20);
    EXPECT_THAT(report::data_uri(low), ::testing::StartsWith("data:image/jpeg;base64,"));
    EXPECT_LT(low.size(), high.size());
    EXPECT_THAT(low, ::testing::EndsWith("\xff\xd9"));
    // Baseline frame header: length 17, 8 bits, 48 rows, 64 columns, 3 components.
    EXPECT_THAT(low, HasSubstr(std::string("\xff\xc0\0\x11\x08\0\x30\0\x40\x03", 10)));
    EXPECT_THROW(output::as_jpeg(folder_ / "p.png", 0), std::invalid_argument);
    EXPECT_THAT(complaint([&] { output::as_jpeg(folder_ / "none.png", 90); }),
                HasSubstr("none.png"));
    write("text.png", "no picture");
    EXPECT_THAT(complaint([&] { output::as_jpeg(folder_ / "text.png", 90); }),
                HasSubstr("text.png"));
}

TEST(ReportBase64, GivesTheVectorsOfRfc4648) {
    EXPECT_EQ(report::base64(""), "");
    EXPECT_EQ(report::base64("f"), "Zg==");
    EXPECT_EQ(report::base64("fo"), "Zm8=");
    EXPECT_EQ(report::base64("foo"), "Zm9v");
    EXPECT_EQ(report::base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(report::base64("\xff\xfe"), "//4=");
}

} // namespace
