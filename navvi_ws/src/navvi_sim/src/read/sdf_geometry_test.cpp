// Poses as libsdformat resolves them, on random worlds, and what it does not let one ask.

#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "sdf_folder.hpp"
#if __has_include(<sdf/sdf.hh>)
#include "libsdformat.hpp"
#endif

namespace navvi_sim::read {
namespace {

/// Writes random models whose poses are relative to whatever came before them.
class RandomWorld {
 public:
  explicit RandomWorld(unsigned seed) : random_(seed) {}

  [[nodiscard]] std::string text() {
    std::vector<std::string> scope;
    std::string body = "<frame name='fw'>" + pose({}) + "</frame>";
    scope.emplace_back("fw");
    for (int i = 0; i < 3; ++i) {
      const std::string name = "m" + std::to_string(i);
      body += model(name, scope, 0);
      scope.push_back(name);
    }
    return "<?xml version='1.0'?><sdf version='1.9'><world name='w'>" + body + "</world></sdf>";
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  const std::string& pick(const std::vector<std::string>& names) {
    return names[static_cast<std::size_t>(uniform(0.0, 0.999) * static_cast<double>(names.size()))];
  }

  std::string pose(const std::vector<std::string>& scope) {
    if (chance(0.15)) return "";
    const std::string base =
        !scope.empty() && chance(0.6) ? " relative_to='" + pick(scope) + "'" : "";
    const bool degrees = chance(0.3);
    std::ostringstream text;
    text << "<pose" << base << (degrees ? " degrees='true'" : "") << ">";
    for (int i = 0; i < 3; ++i) text << uniform(-3.0, 3.0) << " ";
    for (int i = 0; i < 3; ++i) text << uniform(-3.0, 3.0) * (degrees ? 50.0 : 1.0) << " ";
    return text.str() + "</pose>";
  }

  std::string model(const std::string& name, const std::vector<std::string>& outside, int depth) {
    std::vector<std::string> inside{"__model__"};
    std::string body;
    std::vector<std::string> links;
    for (int i = 0; i < 2; ++i) {
      const std::string link = "l" + std::to_string(i);
      std::vector<std::string> around = inside;
      body += "<link name='" + link + "'>" + pose(inside) + "<collision name='c'>" + pose(around) +
              "<geometry><box><size>1 1 1</size></box></geometry></collision></link>";
      inside.push_back(link);
      links.push_back(link);
      const std::string frame = "f" + std::to_string(i);
      const std::string attached = chance(0.5) ? " attached_to='" + pick(links) + "'" : "";
      body += "<frame name='" + frame + "'" + attached + ">" + pose(inside) + "</frame>";
      inside.push_back(frame);
    }
    body +=
        "<joint name='j' type='fixed'><parent>l0</parent><child>l1</child>" + pose({}) + "</joint>";
    inside.emplace_back("j");
    if (depth < 2 && chance(0.6)) {
      body += model("inner", inside, depth + 1);
      inside.emplace_back("inner");
      inside.emplace_back("inner::l1");
      body += "<link name='last'>" + pose(inside) +
              "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision>"
              "</link>";
    }
    const std::string placement =
        chance(0.4) ? " placement_frame='" + pick({"l0", "l1", "f0", "f1", "j"}) + "'" : "";
    return "<model name='" + name + "'" + placement + ">" + pose(outside) + body + "</model>";
  }
  std::string pick(std::initializer_list<const char*> names) {
    return pick(std::vector<std::string>(names.begin(), names.end()));
  }

  std::mt19937 random_;
};

class SdfFrames : public SdfFolder {};

#if __has_include(<sdf/sdf.hh>)
TEST_F(SdfFrames, are_those_of_libsdformat) {
  std::size_t compared = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const std::string text = RandomWorld(seed).text();
    sdf::Root root;
    const sdf::Errors errors = root.LoadSdfString(text);
    for (const sdf::Error& error : errors) ADD_FAILURE() << seed << ": " << error.Message();
    if (!errors.empty()) continue;
    const sdf::World& theirs = *root.WorldByIndex(0);

    const std::size_t end = text.rfind("</world>");
    const LoadedWorld ours = load_world(
        {write("a.world", text.substr(0, end) +
                              "<model name='ground_plane'><pose>0 0 -50 0 0 0</pose><link "
                              "name='l'><collision name='c'><geometry><plane/></geometry>"
                              "</collision></link></model></world></sdf>")});
    for (std::uint64_t i = 0; i < theirs.ModelCount(); ++i) {
      const sdf::Model& model = *theirs.ModelByIndex(i);
      std::vector<JudgedCollision> judged;
      gather(model, resolved(model), judged);
      const Thing* thing = thing_named(ours.world, model.Name());
      ASSERT_NE(thing, nullptr) << seed;
      ASSERT_EQ(thing->shapes.size(), judged.size()) << seed;
      for (std::size_t k = 0; k < judged.size(); ++k) {
        const Eigen::Isometry3d pose = thing->pose * thing->shapes[k].pose;
        EXPECT_TRUE(pose.isApprox(judged[k].pose, 1e-5))
            << "seed " << seed << ", " << model.Name() << ", collision " << k << ":\n"
            << pose.matrix() << "\nand\n"
            << judged[k].pose.matrix() << "\n"
            << text;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 400U);
}
#else
TEST_F(SdfFrames, are_those_of_libsdformat) { GTEST_SKIP() << "libsdformat is not installed"; }
#endif

TEST_F(SdfFrames, follow_quaternions_and_the_old_word_for_relative_to) {
  const std::string box = "<box><size>1 1 1</size></box>";
  const LoadedWorld loaded = load(
      ground_ +
          "<model name='turned'><pose rotation_format='quat_xyzw'>1 2 3 0 0 0.7071068 0.7071068"
          "</pose><link name='l'><collision name='c'><pose>1 0 0 0 0 0</pose><geometry>" +
          box + "</geometry></collision></link></model>" +
          "<model name='old'><link name='a'><pose>5 0 0 0 0 0</pose></link><link name='b'>"
          "<pose frame='a'>0 1 1 0 0 0</pose><collision name='c'><geometry>" +
          box + "</geometry></collision></link></model>",
      "1.9");
  EXPECT_LT(
      (bounds(*thing_named(loaded.world, "turned")).center() - Eigen::Vector3d(1, 3, 3)).norm(),
      1e-5);
  EXPECT_LT((bounds(*thing_named(loaded.world, "old")).center() - Eigen::Vector3d(5, 1, 1)).norm(),
            1e-9);
}

TEST_F(SdfFrames, of_a_merged_model_are_known_outside) {
  write_model("part",
              "<link name='base'><pose>0 0 2 0 0 0</pose><collision name='c'><geometry><box>"
              "<size>1 1 1</size></box></geometry></collision></link>");
  const LoadedWorld loaded =
      load(ground_ +
               "<model name='whole'><include merge='true'><uri>model://part</uri><pose>1 0 0 0 0 0"
               "</pose></include><link name='top'><pose relative_to='base'>0 0 1 0 0 0</pose>"
               "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision>"
               "</link></model>",
           "1.9");
  const Eigen::AlignedBox3d box = bounds(*thing_named(loaded.world, "whole"));
  EXPECT_LT((box.min() - Eigen::Vector3d(0.5, -0.5, 1.5)).norm(), 1e-9);
  EXPECT_LT((box.max() - Eigen::Vector3d(1.5, 0.5, 3.5)).norm(), 1e-9);
}

TEST_F(SdfFrames, that_are_not_there_or_go_in_circles_are_refused) {
  const auto frames = [&](const std::string& more) {
    return sentence_of(
        write_world(ground_ + "\n<model name='m'>" + cube_ + more + "</model>", "1.9"));
  };
  EXPECT_NE(frames("<link name='a'><pose relative_to='b'/></link>").find("line 2"),
            std::string::npos);
  EXPECT_NE(frames("<link name='a'><pose relative_to='b'/></link>"
                   "<link name='b'><pose relative_to='a'/></link>")
                .find("depends on itself"),
            std::string::npos);
  EXPECT_NE(frames("<link name='a'><pose relative_to='a'/></link>"), "");
  EXPECT_NE(frames("<link name='a'><pose relative_to='a::a::a::a'/></link>"), "");
  EXPECT_NE(frames("<link name='a'><pose>1 2 3</pose></link>").find("6 finite numbers"),
            std::string::npos);
  EXPECT_NE(frames("<link name='a'><pose>0 0 0 0 0 nan</pose></link>"), "");
  EXPECT_NE(frames("<link name='a'><pose>0 0 1e7 0 0 0</pose></link>"), "");
  EXPECT_NE(frames("<link name='a'><pose rotation_format='quat_xyzw'>0 0 0 0 0 0 0</pose></link>"),
            "");
  EXPECT_NE(frames("<link name='a'><pose rotation_format='zyx'>0 0 0 0 0 0</pose></link>")
                .find("rotation_format of <pose> is \"zyx\"; allowed are euler_rpy and quat_xyzw"),
            std::string::npos);
  std::string chain;
  for (int i = 0; i < 200; ++i)
    chain += "<frame name='f" + std::to_string(i) + "'><pose relative_to='f" +
             std::to_string(i + 1) + "'/></frame>";
  EXPECT_NE(frames(chain + "<link name='a'><pose relative_to='f0'/></link>"), "");
}

}  // namespace
}  // namespace navvi_sim::read
