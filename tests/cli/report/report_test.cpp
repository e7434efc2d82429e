#include "cli/report/report.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cli/measure/notes.hpp"
#include "cli/report/figures.hpp"
#include "tests/cli/report/sample_measurement.hpp"

namespace sdlc::cli {
namespace {

using render::Measurement;
using test::bare_report;
using test::sample_measurement;
using test::sample_report;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Checks that the text is well-formed XML (names, attributes, nesting and entities); returns the
/// first mistake with its place, or an empty string.
std::string markup_error(const std::string& page) {
  static const std::regex kTag(R"(<(/?)([a-zA-Z0-9]+)((?: [a-zA-Z0-9:-]+="[^"<]*")*)(/?)>)");
  static const std::regex kEntity("&(amp|lt|gt|quot|#39);");
  static constexpr std::string_view kDoctype = "<!DOCTYPE html>";
  if (!page.starts_with(kDoctype)) return "no doctype";
  std::vector<std::string> open;
  for (std::size_t at = kDoctype.size(); at < page.size();) {
    const std::string place = page.substr(at, 60);
    std::smatch match;
    const auto begin = page.begin() + static_cast<std::ptrdiff_t>(at);
    if (page[at] == '&') {
      constexpr auto kHere = std::regex_constants::match_continuous;
      if (!std::regex_search(begin, page.end(), match, kEntity, kHere)) return "entity: " + place;
    } else if (page[at] == '<') {
      // Remove the pictures first: they are long, and std::regex recurses.
      const std::size_t end = page.find('>', at);
      if (end == std::string::npos) return "unfinished: " + place;
      std::string tag = page.substr(at, end + 1 - at);
      if (const std::size_t data = tag.find(";base64,"); data != std::string::npos) {
        tag.erase(data, tag.find('"', data) - data);
      }
      if (!std::regex_match(tag, match, kTag)) return "tag: " + place;
      const std::string name = match[2];
      if (match[1] == "/") {
        if (open.empty() || open.back() != name) return "closes what is not open: " + place;
        open.pop_back();
      } else if (match[4] != "/") {
        open.push_back(name);
      }
      at = end;
    }
    ++at;
  }
  return open.empty() ? "" : "not closed: " + open.back();
}

/// The visible text: no tags, no style sheet.
std::string visible_text(const std::string& page) {
  std::string text;
  bool is_tag = false;
  for (std::size_t i = page.find("<body>"); i < page.size(); ++i) {
    if (page[i] == '<') is_tag = true;
    if (!is_tag) text += page[i];
    if (page[i] == '>') {
      is_tag = false;
      text += ' ';
    }
  }
  return text;
}

std::vector<std::string> all_matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

struct Degenerate {
  std::string name;
  Measurement measurement;
};

/// Incomplete and unusual measurements.
std::vector<Degenerate> degenerates() {
  std::vector<Degenerate> all{{"nothing", {}}};
  const auto add = [&](std::string name, auto&& change) {
    Measurement measurement = sample_measurement();
    change(measurement);
    all.push_back({std::move(name), std::move(measurement)});
  };
  add("one point", [](Measurement& m) {
    m.points.resize(1);
    m.series.resize(1);
    m.series[0].points = {0};
    m.series[0].slope.reset();
  });
  add("no reference", [](Measurement& m) { m.reference.reset(); });
  add("no error", [](Measurement& m) {
    for (render::Point& point : m.points) point.error = {};
    m.reference->error = {};
  });
  add("no numbers", [](Measurement& m) {
    for (render::Point& point : m.points) {
      point.error = {.value = kInfinity, .interval = {kNan, kInfinity}};
      point.seconds = {.value = kNan, .interval = {kNan, kNan}};
      point.samples_per_second = point.rays_per_second = kInfinity;
      point.flip = point.cut_paths = kNan;
      point.difference.rmse = point.difference.relative_mse = kInfinity;
      point.difference.largest.value = -kInfinity;
    }
    for (render::DepthLoss& depth : m.depths) {
      depth.loss.value = kNan;
      depth.relative_seconds = kInfinity;
    }
    for (render::Series& series : m.series) series.slope->value = kNan;
    m.reference->error = {.value = kInfinity, .interval = {0.1, kInfinity}};
    m.reference->mean_radiance = kNan;
    m.precision->mean_difference.value = m.precision->relative_seconds = kNan;
    m.recommendations[1].seconds = {.value = kInfinity, .interval = {kNan, kNan}};
    m.spent_seconds = kNan;
  });
  add("one unknown", [](Measurement& m) { m.points[2].error.value = kInfinity; });
  add("down to nothing", [](Measurement& m) {
    for (render::Point& point : m.points) point.error.interval.from = 0;
    for (render::Point& point : m.points) point.seconds.interval.from = 0;
  });
  add("all at once", [](Measurement& m) {
    for (render::Point& point : m.points) point.seconds = m.points[0].seconds;
  });
  add("many series", [](Measurement& m) {
    for (int i = 0; i < 30; ++i) m.series.push_back(m.series[static_cast<std::size_t>(i % 4)]);
  });
  add("no main recommendation", [](Measurement& m) { m.recommendations[1].is_main = false; });
  return all;
}

TEST(HtmlReport, IsWellFormedXml) {
  const Measurement measurement = sample_measurement();
  EXPECT_EQ(markup_error(html_report(sample_report(measurement))), "");
  for (const Degenerate& degenerate : degenerates()) {
    EXPECT_EQ(markup_error(html_report(bare_report(degenerate.measurement))), "")
        << degenerate.name;
  }
}

TEST(HtmlReport, NeitherLoadsNorRunsAnything) {
  const Measurement measurement = sample_measurement();
  const std::string page = html_report(sample_report(measurement));
  for (const char* part : {"<script", "http:", "https:", "@import", "url(//", "javascript:"}) {
    EXPECT_THAT(page, Not(HasSubstr(part)));
  }
  EXPECT_THAT(all_matches(page, " (on[a-z]+)="), testing::IsEmpty());
  EXPECT_THAT(all_matches(page, R"((?:src|href)="([^"]{5}))"),
              testing::Each(testing::AnyOf(testing::StartsWith("#"), "data:")));
}

TEST(HtmlReport, WhatIsNoNumberIsUnknown) {
  for (const Degenerate& degenerate : degenerates()) {
    const std::string page = html_report(bare_report(degenerate.measurement));
    EXPECT_THAT(all_matches(page, R"([^a-z](nan|inf|infinity)[^a-z])"), testing::IsEmpty())
        << degenerate.name;
  }
}

TEST(HtmlReport, IdentifiersAreUniqueAndReferencesLeadSomewhere) {
  const Measurement measurement = sample_measurement();
  const std::string page = html_report(sample_report(measurement));
  const std::vector<std::string> all = all_matches(page, " id=\"([^\"]*)\"");
  const std::set<std::string> ids(all.begin(), all.end());
  EXPECT_EQ(ids.size(), all.size());
  for (const char* reference :
       {" href=\"#([^\"]*)\"", " aria-labelledby=\"([^\"]*)\"", " aria-describedby=\"([^\"]*)\""}) {
    for (const std::string& id : all_matches(page, reference)) {
      EXPECT_TRUE(ids.contains(id)) << id;
    }
  }
}

TEST(HtmlReport, HeadingsDescendOneLevelAtATime) {
  const Measurement measurement = sample_measurement();
  int last = 0;
  for (const std::string& level :
       all_matches(html_report(sample_report(measurement)), "<h([1-6])[ >]")) {
    EXPECT_LE(std::stoi(level), last + 1);
    last = std::stoi(level);
  }
  EXPECT_GT(last, 0);
}

TEST(HtmlReport, BeginsWithTheRecommendation) {
  const Measurement measurement = sample_measurement();
  const std::string text = visible_text(html_report(sample_report(measurement)));
  const std::size_t lead = text.find("For an error of 1\u00a0%:");
  ASSERT_NE(lead, std::string::npos);
  EXPECT_THAT(text.substr(lead, 200),
              testing::AllOf(HasSubstr("--samples 1024"), HasSubstr("17.7\u00a0s (16.8 to 18.6"),
                             HasSubstr("error 0.75\u00a0% (0.712 to 0.787")));
  EXPECT_LT(lead, text.find("Error and render time", text.find("Error and render time") + 1));
  EXPECT_THAT(text, HasSubstr("--light-sampling on"));
}

TEST(HtmlReport, HasTheFiguresOfEachRender) {
  const Measurement measurement = sample_measurement();
  const std::string page = html_report(sample_report(measurement));
  const std::string table = page.substr(page.find("<section id=\"renders\""));
  for (const render::Point& point : measurement.points) {
    for (const std::string& text :
         {read(point.error, percent).value, read(point.error, percent).interval,
          read(point.seconds, duration).value, read(point.seconds, duration).interval,
          figure(point.difference.rmse), figure(point.difference.relative_mse), figure(point.flip),
          percent(point.cut_paths)}) {
      EXPECT_THAT(table, testing::AnyOf(HasSubstr(">" + text + "<"), HasSubstr(">" + text + " <")));
    }
  }
  EXPECT_THAT(table, HasSubstr(">not distinguished<"));
  EXPECT_THAT(table, HasSubstr(">dominated<"));
}

TEST(HtmlReport, DrawsEachRenderInBothCharts) {
  Measurement measurement = sample_measurement();
  measurement.thread_scaling.clear();
  const std::string page = html_report(bare_report(measurement));
  EXPECT_EQ(all_matches(page, "<g class=\"(point) ").size(), 2 * measurement.points.size());
}

TEST(HtmlReport, DrawsTheSpeedUpBesideTheIdeal) {
  Measurement measurement = sample_measurement();
  const std::string page = html_report(bare_report(measurement));
  EXPECT_EQ(all_matches(page, "<g class=\"(point) ").size(),
            2 * (measurement.points.size() + measurement.thread_scaling.size()));
  EXPECT_THAT(page, HasSubstr("<h2 id=\"threads-heading\">Threads</h2>"));
  EXPECT_THAT(page, HasSubstr("Renders of 128 samples with numbers of threads"));
  EXPECT_THAT(page, HasSubstr("byte for byte"));
  measurement.thread_pictures_are_same = false;
  EXPECT_THAT(html_report(bare_report(measurement)), Not(HasSubstr("byte for byte")));
  measurement.thread_scaling.clear();
  EXPECT_THAT(html_report(bare_report(measurement)), Not(HasSubstr("threads-heading")));
}

TEST(HtmlReport, EscapesAllThatComesFromOutside) {
  const std::string hostile = "<img src=x onerror='a'>&\"\x1b[1m";
  Measurement measurement = sample_measurement();
  measurement.left_out[0].reason = hostile;
  measurement.precision->bound = hostile;
  Report report = sample_report(measurement);
  report.provenance = {
      .scene = hostile, .version = hostile, .command = hostile, .machine = {{hostile, hostile}}};
  report.picture.title = hostile;
  report.crops[0].title = report.crops[0].images[0].title = hostile;
  report.against->version = hostile;
  report.against->notes = report.notes = {hostile};
  const std::string page = html_report(report);
  EXPECT_EQ(markup_error(page), "");
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(page, Not(HasSubstr("\x1b")));
  EXPECT_GE(all_matches(page, "(&lt;img src=x onerror=&#39;a&#39;&gt;&amp;&quot;␛)").size(), 12u);
}

TEST(HtmlReport, ShowsFirstWhatIsMissing) {
  Measurement measurement = sample_measurement();
  EXPECT_THAT(html_report(bare_report(measurement)), Not(HasSubstr("<p class=\"callout\">")));
  measurement.is_complete = false;
  measurement.full_width = 1920;
  Report report = bare_report(measurement);
  report.notes = notes_of(measurement);
  report.notes.emplace_back("a lamp was hardly reached");
  const std::string page = html_report(report);
  for (const char* part : {"a lamp was hardly reached", "interrupted:", "1920 × 225"}) {
    EXPECT_LT(page.find(part), page.find("For an error of")) << part;
  }
}

TEST(HtmlReport, ShowsWhyAnotherPrecisionIsImpossible) {
  Measurement measurement = sample_measurement();
  EXPECT_THAT(html_report(bare_report(measurement)),
              HasSubstr("float minus double: -0.002\u00a0% (-0.006 to 0.002\u00a0%) of the mean "
                        "radiance: <strong>not distinguished"));
  measurement.precision->mean_difference.interval = {-3e-5, -1e-5};
  EXPECT_THAT(html_report(bare_report(measurement)), HasSubstr("a significant difference"));
  measurement.precision->refusal = "the scene is too large";
  EXPECT_THAT(html_report(bare_report(measurement)),
              HasSubstr("between float and double was not measured: the scene is too large."));
}

TEST(HtmlReport, HoldsRendersAgainstEarlierOnes) {
  const Measurement measurement = sample_measurement();
  Report report = sample_report(measurement);
  EXPECT_THAT(html_report(report),
              testing::AllOf(HasSubstr(">better<"), HasSubstr(">worse<"),
                             HasSubstr("0.91\u00a0times (0.874 to 0.946\u00a0times)")));
  report.against->time_ratio.reset();
  report.against->points.clear();
  EXPECT_THAT(html_report(report), testing::AllOf(HasSubstr("Times are not compared."),
                                                  HasSubstr("no render in common")));
}

TEST(HtmlReport, PicturesAreInIt) {
  const Measurement measurement = sample_measurement();
  const std::string page = html_report(sample_report(measurement));
  EXPECT_EQ(all_matches(page, "(data:image/png;base64,iVBORw0KGgo)").size(), 1u + 2 * 6 + 3);
  EXPECT_THAT(page, HasSubstr("width=\"48\" height=\"32\" alt=\"4 samples, error 60 %\""));
  EXPECT_THAT(page, HasSubstr("the brightest colour 50\u00a0% of the mean"));
}

TEST(HtmlReport, ReportsIfMoreLightIsLostThanWasMeasured) {
  Measurement measurement = sample_measurement();
  EXPECT_THAT(html_report(sample_report(measurement)), Not(HasSubstr("a lower bound")));
  EXPECT_THAT(notes_of(measurement), IsEmpty());
  measurement.depths_have_converged = false;
  const Report report = sample_report(measurement);
  EXPECT_THAT(html_report(report), HasSubstr("Light lost, at least"));
  EXPECT_THAT(notes_of(measurement),
              Contains(HasSubstr("is a lower bound: paths deeper than 64 may carry more")));
}

TEST(HtmlReport, IsTheSameEachTime) {
  const Measurement measurement = sample_measurement();
  EXPECT_EQ(html_report(sample_report(measurement)), html_report(sample_report(measurement)));
}

}  // namespace
}  // namespace sdlc::cli
