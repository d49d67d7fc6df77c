#include <gtest/gtest.h>
#include <unistd.h>

#include <rapidcheck/gtest.h>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/program_folder.h"
#include "measure/camera_path.h"

namespace fb {
namespace {

constexpr std::string_view kTwoKeys = R"([[key]]
time = 0
eye = [1, 2.5, -3]
orientation = [0, 0, 0, 1]

[[key]]
time = 2.5
eye = [4, 5, 6]
look_at = [4, 5, 16]
fovy = 45
near = 0.5
cut = true
)";

double difference(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(a - b);
}

bool same(const PathKey& a, const PathKey& b) {
    return a.timeSeconds == b.timeSeconds && a.camera.eye == b.camera.eye &&
           a.camera.orientation == b.camera.orientation && a.camera.fovyRadians == b.camera.fovyRadians &&
           a.camera.nearMetres == b.camera.nearMetres && a.cut == b.cut;
}

TEST(PathToml, ReadsWhatItSays) {
    const Result<CameraPath> path = parsePath(kTwoKeys, "some/folder/tour.toml");
    ASSERT_TRUE(path.has_value()) << path.error().oneLine();
    EXPECT_EQ(path->name, "tour");
    ASSERT_EQ(path->keys.size(), 2u);
    const PathKey &a = path->keys[0], &b = path->keys[1];
    EXPECT_EQ(a.timeSeconds, 0.0);
    EXPECT_EQ(a.camera.eye, glm::dvec3(1, 2.5, -3));
    EXPECT_EQ(a.camera.orientation, glm::dquat(1, 0, 0, 0));
    EXPECT_EQ(a.camera.fovyRadians, Camera{}.fovyRadians);
    EXPECT_EQ(a.camera.nearMetres, Camera{}.nearMetres);
    EXPECT_FALSE(a.cut);
    EXPECT_EQ(b.timeSeconds, 2.5);
    EXPECT_LT(difference(b.camera.forward(), {0, 0, 1}), 1e-12);
    EXPECT_LT(difference(b.camera.up(), {0, 1, 0}), 1e-12);
    EXPECT_DOUBLE_EQ(b.camera.fovyRadians, glm::radians(45.0));
    EXPECT_EQ(b.camera.nearMetres, 0.5);
    EXPECT_TRUE(b.cut);
}

TEST(PathToml, TurnsTheCameraByUpOfTheKeyOrOfTheFile) {
    const std::string_view text = R"(up = [0, 0, 2]
[[key]]
time = 0
eye = [0, 0, 0]
look_at = [5, 0, 0]
[[key]]
time = 1
eye = [0, 0, 0]
look_at = [5, 0, 0]
up = [0, -1, 0]
)";
    const Result<CameraPath> path = parsePath(text, "p.toml");
    ASSERT_TRUE(path.has_value()) << path.error().oneLine();
    EXPECT_LT(difference(path->keys[0].camera.up(), {0, 0, 1}), 1e-12);
    EXPECT_LT(difference(path->keys[1].camera.up(), {0, -1, 0}), 1e-12);
    EXPECT_LT(difference(path->keys[1].camera.forward(), {1, 0, 0}), 1e-12);
}

TEST(PathToml, NormalisesAnOrientationThatIsNearlyUnit) {
    const Result<CameraPath> path =
        parsePath("[[key]]\ntime=0\neye=[0,0,0]\norientation=[0,0.7071,0,0.7071]\n", "p");
    ASSERT_TRUE(path.has_value());
    EXPECT_NEAR(glm::length(path->keys[0].camera.orientation), 1.0, 1e-15);
}

TEST(PathToml, GivesTheBuiltInPathsBackBitByBit) {
    SceneInfo scene;
    scene.bounds = {glm::dvec3(-0.3, 0.1, -7.7), glm::dvec3(5.5, 3.3, 1.1)};
    for (std::string_view name : builtInPathNames()) {
        const CameraPath path = *loadPath(name, scene);
        const Result<CameraPath> back = parsePath(pathToml(path), std::string(name) + ".toml");
        ASSERT_TRUE(back.has_value()) << back.error().oneLine();
        EXPECT_EQ(back->name, name);
        ASSERT_EQ(back->keys.size(), path.keys.size());
        for (std::size_t k = 0; k < path.keys.size(); ++k)
            EXPECT_TRUE(same(back->keys[k], path.keys[k])) << name << k;
    }
}

RC_GTEST_PROP(PathToml, GivesAnyPathBackBitByBit, ()) {
    const auto number = [](double size) { return size * (*rc::gen::inRange(-1000000, 1000001) / 999999.0); };
    CameraPath path;
    double time = *rc::gen::inRange(0, 5) / 3.0;
    for (int i = *rc::gen::inRange(1, 6); i > 0; --i) {
        PathKey key;
        key.timeSeconds = time;
        time += *rc::gen::inRange(1, 1000) / 77.0;
        const double size = std::pow(10.0, *rc::gen::inRange(-9, 12));
        key.camera.eye = {number(size), number(size), i % 2 ? -0.0 : 3.0};
        key.camera.orientation = glm::normalize(glm::dquat(number(1) + 2.0, number(1), number(1), number(1)));
        key.camera.fovyRadians = *rc::gen::inRange(100, 2900) / 1000.0;
        key.camera.nearMetres = std::pow(10.0, *rc::gen::inRange(-60, 20) / 10.0);
        key.cut = *rc::gen::arbitrary<bool>();
        path.keys.push_back(key);
    }
    const Result<CameraPath> back = parsePath(pathToml(path), "p.toml");
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->keys.size() == path.keys.size());
    for (std::size_t k = 0; k < path.keys.size(); ++k) {
        RC_ASSERT(same(back->keys[k], path.keys[k]));
        RC_ASSERT(std::signbit(back->keys[k].camera.eye.z) == std::signbit(path.keys[k].camera.eye.z));
    }
}

struct Damage {
    std::string text, place, reason;
};

std::string keyWith(const std::string& lines) {
    return "[[key]]\n" + lines;
}

TEST(PathToml, RefusesEveryKindOfDamageByFileAndLine) {
    const std::string eye = "eye = [0, 0, 0]\n", time = "time = 0\n", turn = "orientation = [0, 0, 0, 1]\n";
    const std::string good = keyWith(time + eye + turn);
    const std::vector<Damage> damages = {
        {"", "", "no keys"},
        {"key = []\n", "", "no keys"},
        {"key = 3\n", "", "no keys"},
        {"key = [1]\n", "line 1", "not a table"},
        {"[[key]\n", "line 1", ""},
        {"speed = 3\n" + good, "line 1", "\"speed\" is not part of a path"},
        {"up = [0, 1]\n" + good, "line 1", "list of 3"},
        {keyWith(eye + turn), "line 1", "needs time"},
        {keyWith(time + turn), "line 1", "needs eye"},
        {keyWith(time + eye), "line 1", "needs orientation or look_at"},
        {keyWith("time = \"0\"\n" + eye + turn), "line 2", "time is not a number"},
        {keyWith("time = nan\n" + eye + turn), "line 2", "time is not finite"},
        {keyWith("time = inf\n" + eye + turn), "line 2", "time is not finite"},
        {keyWith("time = -0.1\n" + eye + turn), "line 2", "time is out of range"},
        {keyWith("time = 1e8\n" + eye + turn), "line 2", "time is out of range"},
        {keyWith(time + "eye = 3\n" + turn), "line 3", "eye is not a list of 3"},
        {keyWith(time + "eye = [0, 0]\n" + turn), "line 3", "eye is not a list of 3"},
        {keyWith(time + "eye = [0, 0, 0, 0]\n" + turn), "line 3", "eye is not a list of 3"},
        {keyWith(time + "eye = [0, true, 0]\n" + turn), "line 3", "eye is not a number"},
        {keyWith(time + "eye = [0, nan, 0]\n" + turn), "line 3", "eye is not finite"},
        {keyWith(time + "eye = [0, 0, -1.1e12]\n" + turn), "line 3", "eye is out of range"},
        {keyWith(time + "eye = [0, 0, 9223372036854775807]\n" + turn), "line 3", "eye is out of range"},
        {keyWith(time + eye + "orientation = [0, 0, 1]\n"), "line 4", "orientation is not a list of 4"},
        {keyWith(time + eye + "orientation = [0, 0, 0, 0]\n"), "line 4", "not a unit quaternion"},
        {keyWith(time + eye + "orientation = [0, 0, 0, 1.01]\n"), "line 4", "not a unit quaternion"},
        {keyWith(time + eye + "orientation = [0, nan, 0, 1]\n"), "line 4", "orientation is not finite"},
        {keyWith(time + eye + turn + "look_at = [1, 0, 0]\n"), "line 5", "look_at beside orientation"},
        {keyWith(time + eye + turn + "up = [0, 1, 0]\n"), "line 5", "up beside orientation"},
        {keyWith(time + eye + "look_at = [0, 0, 0]\n"), "line 4", "the eye's own place"},
        {keyWith(time + eye + "look_at = [0, 7, 0]\n"), "line 1", "looks along up"},
        {keyWith(time + eye + "look_at = [0, 0, 7]\nup = [0, 0, 0]\n"), "line 1", "up has no length"},
        {keyWith(time + eye + turn + "fovy = 0\n"), "line 5", "fovy is out of range"},
        {keyWith(time + eye + turn + "fovy = 180\n"), "line 5", "fovy is out of range"},
        {keyWith(time + eye + turn + "fovy_radians = 3.2\n"), "line 5", "fovy_radians is out of range"},
        {keyWith(time + eye + turn + "fovy = 60\nfovy_radians = 1\n"), "line 6", "fovy_radians beside fovy"},
        {keyWith(time + eye + turn + "near = 0\n"), "line 5", "near is out of range"},
        {keyWith(time + eye + turn + "near = -1\n"), "line 5", "near is out of range"},
        {keyWith(time + eye + turn + "cut = 1\n"), "line 5", "cut is neither true nor false"},
        {keyWith(time + eye + turn + "roll = 1\n"), "line 5", "\"roll\" is not part of a key"},
        {keyWith(time + "time = 1\n" + eye + turn), "line 3", ""},
        {good + good, "line 6", "time is not later"},
        {good + keyWith("time = 1\n" + eye + turn) + keyWith("time = 0.5\n" + eye + turn), "line 10",
         "time is not later"},
    };
    for (const Damage& damage : damages) {
        const Result<CameraPath> path = parsePath(damage.text, "bad.toml");
        ASSERT_FALSE(path.has_value()) << damage.text;
        EXPECT_EQ(path.error().file, "bad.toml") << damage.text;
        EXPECT_EQ(path.error().place, damage.place) << damage.text << path.error().oneLine();
        EXPECT_NE(path.error().reason.find(damage.reason), std::string::npos)
            << damage.text << path.error().oneLine();
    }
}

TEST(PathToml, SurvivesEveryTruncationAndEveryChangedByte) {
    const std::string whole(kTwoKeys);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const Result<CameraPath> path = parsePath(whole.substr(0, length), "p.toml");
        EXPECT_TRUE(path ? path->keys.size() <= 2u : !path.error().reason.empty()) << length;
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (char c : {'\0', '\n', '"', '[', '9', '-', '\xff'}) {
            std::string changed = whole;
            changed[at] = c;
            const Result<CameraPath> path = parsePath(changed, "p.toml");
            if (!path) continue;
            for (const PathKey& key : path->keys) EXPECT_TRUE(isUsable(key.camera)) << changed;
        }
    }
}

TEST(PathToml, RefusesOneKeyMoreThanTheCap) {
    std::string text = "key=[";
    for (std::size_t k = 0; k <= kPathKeyCap; ++k) text += k % 1000 ? "{}," : "{},\n";
    const Result<CameraPath> path = parsePath(text + "]", "long.toml");
    ASSERT_FALSE(path.has_value());
    EXPECT_NE(path.error().reason.find("more than 100000 keys"), std::string::npos) << path.error().oneLine();
    EXPECT_EQ(path.error().place, "line 101");
}

class PathFile : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("fb_path_test_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path folder_;
};

TEST_F(PathFile, IsSavedAndLoadedAsItIs) {
    CameraPath path = *parsePath(kTwoKeys, "tour.toml");
    const std::filesystem::path file = folder_ / "new" / "tour.toml";
    ASSERT_TRUE(savePath(path, file).has_value());
    const Result<CameraPath> back = loadPath(file.string(), {});
    ASSERT_TRUE(back.has_value()) << back.error().oneLine();
    EXPECT_EQ(back->name, "tour");
    ASSERT_EQ(back->keys.size(), 2u);
    EXPECT_TRUE(same(back->keys[0], path.keys[0]));
    EXPECT_TRUE(same(back->keys[1], path.keys[1]));
}

TEST_F(PathFile, IsNotSavedWhereItCouldNotBeReadBack) {
    CameraPath path = *parsePath(kTwoKeys, "tour.toml");
    path.keys[1].timeSeconds = 0.0;
    EXPECT_FALSE(savePath(path, folder_ / "p.toml").has_value());
    path.keys[1].timeSeconds = 1.0;
    path.keys[1].camera.eye.x = std::nan("");
    EXPECT_FALSE(savePath(path, folder_ / "p.toml").has_value());
    path.keys.assign(kPathKeyCap + 1, PathKey{});
    EXPECT_FALSE(savePath(path, folder_ / "p.toml").has_value());
    EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(PathFile, ThatIsMissingOrNoFileIsAnError) {
    const Result<CameraPath> missing = loadPath((folder_ / "none.toml").string(), {});
    ASSERT_FALSE(missing.has_value());
    EXPECT_NE(missing.error().file.find("none.toml"), std::string::npos);
    EXPECT_FALSE(loadPath(folder_.string(), {}).has_value());
    const Result<CameraPath> unknown = loadPath("wlak", {});
    ASSERT_FALSE(unknown.has_value());
    EXPECT_NE(unknown.error().hint.find("walk-to-fly"), std::string::npos);
    EXPECT_NE(unknown.error().hint.find("look-around.toml"), std::string::npos);
}

TEST(ShippedPaths, AreFoundByNameAndAreWhole) {
    for (const char* name : {"look-around", "look-around.toml", "over-the-roofs"}) {
        const Result<CameraPath> path = loadPath(name, {});
        ASSERT_TRUE(path.has_value()) << path.error().oneLine();
        EXPECT_EQ(path->durationSeconds(), 30.0);
    }
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(programFolder() / "resources" / "paths")) {
        const Result<CameraPath> path = loadPath(entry.path().string(), {});
        EXPECT_TRUE(path.has_value()) << path.error().oneLine();
        ++files;
    }
    EXPECT_GE(files, 2);
}

// Half-way through the first quarter turn to the left of -z.
TEST(ShippedPaths, LookAroundTurnsOnTheSpot) {
    const CameraPath path = *loadPath("look-around", {});
    EXPECT_LT(difference(path.at(2.5).forward(), {-std::sqrt(0.5), 0, -std::sqrt(0.5)}), 1e-9);
    EXPECT_LT(difference(path.at(7.5).forward(), {-std::sqrt(0.5), 0, std::sqrt(0.5)}), 1e-9);
    EXPECT_LT(difference(path.at(17.5).forward(), {std::sqrt(0.5), 0, -std::sqrt(0.5)}), 1e-9);
    EXPECT_EQ(path.velocityAt(7.0), glm::dvec3(0.0));
}

}  // namespace
}  // namespace fb
