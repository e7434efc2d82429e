#include <algorithm>
#include <filesystem>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include "render/math/fnv.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

/// In the order of the file, of which the digest depends.
using json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kScene = R"(scene 1
camera main { from: (0, 1, 5), at: (0, 0.5, 0), fov: 30deg }
background { bottom: white, top: #80b3ff }
sphere ball { center: (0, 0.5, 0), radius: 0.5, material: specular(color: tan, fuzz: 0.3) }
render { width: 6, samples: 8, depth: 4 }
)";

/// The digest that makes a change of study.json look genuine.
std::string digest_of(const json& study) {
  render::Fnv1a hash;
  hash.add(study.dump());
  return fmt::format("{:016x}", hash.value());
}

class MeasureFolder : public testing::Test {
 protected:
  void SetUp() override { write_text(folder_ / "ball.scene", kScene); }

  ProgramResult run(const std::string& arguments = "") const {
    return run_shell(folder_.path(),
                     "\"$SDLC\" measure ball.scene --budget 20s --quiet --work kept " + arguments);
  }
  fs::path kept(const std::string& name) const { return folder_ / "kept" / name; }
  /// Runs the command with `study` instead of the saved file.
  void expect_refused(const json& study, const std::string& words) const {
    write_text(kept("study.json"), study.dump());
    const ProgramResult result = run();
    EXPECT_EQ(result.exit_code, 2) << words;
    EXPECT_THAT(result.err, HasSubstr("its study.json cannot be read ("));
    EXPECT_THAT(result.err, HasSubstr(words));
    EXPECT_THAT(result.err, HasSubstr("; remove the folder to start again"));
    EXPECT_EQ(result.out, "");
  }

  const TemporaryFolder folder_;
};

TEST_F(MeasureFolder, IsRefusedWhereAFileInItIsDamaged) {
  ASSERT_EQ(run().exit_code, 0);
  const auto expect_told = [&](const std::string& name) {
    const std::string whole = content_of(kept(name));
    std::string damaged = whole;
    damaged[damaged.size() / 2] ^= 1;
    write_text(kept(name), damaged);
    const ProgramResult result = run();
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("its " + name + " is damaged; remove the folder"));
    fs::remove(kept(name));
    EXPECT_THAT(run().err, HasSubstr("its " + name + " is missing"));
    write_text(kept(name), whole);
  };
  expect_told("reference.f32");
  expect_told("reference.map.png");
  expect_told("reference.crop.png");
  EXPECT_EQ(run().exit_code, 0);
}

TEST_F(MeasureFolder, IsOfOneProcessAtATime) {
  ASSERT_EQ(run().exit_code, 0);
  const int lock = ::open(kept("lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(lock, 0);
  ASSERT_EQ(::flock(lock, LOCK_EX | LOCK_NB), 0) << "a run that has ended holds it no longer";
  const std::string before = content_of(kept("study.json"));
  const ProgramResult result = run();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("`kept`: another sdlc is using it"));
  EXPECT_EQ(content_of(kept("study.json")), before);
  ::close(lock);
  EXPECT_EQ(run().exit_code, 0);
}

TEST_F(MeasureFolder, IsRefusedWhereItHoldsFilesOfSomethingElse) {
  fs::create_directory(folder_ / "kept");
  write_text(kept("reference.f32"), "mine");
  const ProgramResult result = run();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("it holds other files; name a new or an empty folder"));
  EXPECT_THAT(names_in(folder_ / "kept"), ElementsAre("reference.f32"))
      << "not even a lock is added";
  fs::remove(kept("reference.f32"));
  write_text(kept("lock"), "");
  EXPECT_EQ(run().exit_code, 0) << "a lock alone is of a run that ended at once";
}

TEST_F(MeasureFolder, TakesNoNoticeOfFilesThatItsStudyDoesNotName) {
  ASSERT_EQ(run().exit_code, 0);
  json file = json::parse(content_of(kept("study.json")));
  // As saved before the reference was rendered.
  json& study = file["study"];
  json& ledger = study["ledger"];
  ledger["reference"] = nullptr;
  for (const char* name : {"points", "depths", "precisions"}) ledger[name] = json::array();
  study["pictures"] = json::array();
  study["digests"] = json::object();
  file["digest"] = digest_of(study);
  write_text(kept("study.json"), file.dump());
  write_text(kept("reference.f32"), "of a run that was killed");
  const ProgramResult again = run();
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(content_of(kept("reference.f32")), "of a run that was killed");
  EXPECT_EQ(run().exit_code, 0);
}

TEST_F(MeasureFolder, IsRefusedWhereItsStudyWasChanged) {
  ASSERT_EQ(run().exit_code, 0);
  const json study = json::parse(content_of(kept("study.json")));
  const auto expect_told = [&](const char* pointer, const json& value,
                               const std::string& words = "it was changed") {
    json changed = study;
    changed[json::json_pointer(pointer)] = value;
    expect_refused(changed, words);
  };
  expect_told("/study/ledger/points", json::array());
  expect_told("/study/ledger/points/0/timings", json::array());
  expect_told("/study/ledger/plan/width", -16);
  expect_told("/study/ledger/plan/tasks/1/samples", 1e300);
  expect_told("/study/ledger/plan", nullptr);
  expect_told("/study/layout/map_width", 1);
  expect_told("/study/layout/x", 6);
  expect_told("/study/pictures/0", "../../etc/passwd");
  expect_told("/study/digests/reference.f32", "0");
  expect_told("/digest", "0");
  expect_told("/digest", 7, "its `digest` is no text");
  expect_told("/format", "other", "it is not a measurement");
  json other_plan = study;
  other_plan["study"]["ledger"]["plan"]["width"] = -16;
  other_plan["digest"] = digest_of(other_plan["study"]);
  expect_refused(other_plan, "its `width` is not a whole number from 0 to");
  json unnamed = study;
  unnamed["study"]["digests"].erase("reference.f32");
  unnamed["digest"] = digest_of(unnamed["study"]);
  write_text(kept("study.json"), unnamed.dump());
  EXPECT_THAT(run().err, HasSubstr("its reference.f32 is damaged"));
  write_text(kept("study.json"), study.dump());
  EXPECT_EQ(run().exit_code, 0);
}

}  // namespace
}  // namespace sdlc::test
