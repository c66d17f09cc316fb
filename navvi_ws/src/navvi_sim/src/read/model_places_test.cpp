#include "read/model_places.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "sdf_folder.hpp"

namespace navvi_sim::read {
namespace {

/// A machine with a home of its own, and nothing in the environment.
class ModelPlacesTest : public SdfFolder {
 protected:
  ModelPlacesTest() {
    for (const char* name :
         {"GAZEBO_MODEL_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "SDF_PATH",
          "GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"})
      set(name, "");
    set("HOME", (folder_ / "home").string());
  }
  ~ModelPlacesTest() override {
    for (const auto& [name, value] : before_)
      if (value)
        setenv(name.c_str(), value->c_str(), 1);
      else
        unsetenv(name.c_str());
  }

  void set(const std::string& name, const std::string& value) {
    const char* known = std::getenv(name.c_str());
    before_.emplace(name, known == nullptr ? std::nullopt : std::optional<std::string>(known));
    setenv(name.c_str(), value.c_str(), 1);
  }
  /// \param width  m
  void write_crate(const std::string& folder, double width) const {
    write(folder + "/model.config", "<model><sdf version='1.6'>model.sdf</sdf></model>");
    write(folder + "/model.sdf",
          "<sdf version='1.6'>" +
              model("crate", "<box><size>" + std::to_string(width) + " 1 1</size></box>") +
              "</sdf>");
  }
  /// m, of the crate that a world under w/ includes; 0 if it is not there.
  [[nodiscard]] double width_of(const std::string& uri) const {
    const std::string file =
        write("w/a.world", "<sdf version='1.6'><world name='w'>" + ground_ + "<include><uri>" +
                               uri + "</uri></include></world></sdf>");
    const LoadedWorld loaded =
        load_world({file, "", 1, Workers::as_laid_out, "", Missing::leave_out});
    const Thing* crate = thing_named(loaded.world, "crate");
    return crate == nullptr ? 0.0 : bounds(*crate).sizes().x();
  }

 private:
  std::map<std::string, std::optional<std::string>> before_;
};

TEST_F(ModelPlacesTest, are_those_that_the_environment_names) {
  for (const char* name :
       {"GAZEBO_MODEL_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "SDF_PATH"}) {
    EXPECT_EQ(width_of("model://crate"), 0.0) << name;
    write_crate("there/crate", 2.0);
    set(name, "/nowhere:" + (folder_ / "there").string());
    EXPECT_NEAR(width_of("model://crate"), 2.0, 1e-9) << name;
    set(name, "");
  }
}

TEST_F(ModelPlacesTest, are_Gazebos_own_after_those_beside_the_world) {
  write_crate("home/.gazebo/models/crate", 2.0);
  EXPECT_NEAR(width_of("model://crate"), 2.0, 1e-9);
  write_crate("w/models/crate", 3.0);
  EXPECT_NEAR(width_of("model://crate"), 3.0, 1e-9);
}

TEST_F(ModelPlacesTest, hold_downloads_from_Fuel_by_version) {
  const std::string uri = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Big%20Crate";
  EXPECT_EQ(width_of(uri), 0.0);
  const std::string cache =
      "home/.ignition/fuel/fuel.ignitionrobotics.org/openrobotics/models/big crate/";
  write_crate(cache + "2", 2.0);
  write_crate(cache + "10", 3.0);
  EXPECT_NEAR(width_of(uri), 3.0, 1e-9);
  EXPECT_NEAR(width_of(uri + "/tip"), 3.0, 1e-9);
  EXPECT_NEAR(width_of(uri + "/2"), 2.0, 1e-9);
  EXPECT_EQ(width_of(uri + "/3"), 0.0);
  EXPECT_EQ(width_of(uri + "/2/files/../../10"), 0.0);
}

TEST_F(ModelPlacesTest, give_the_files_of_a_download) {
  write_crate("home/.gz/fuel/fuel.gazebosim.org/me/models/crate/1", 2.0);
  write("home/.gz/fuel/fuel.gazebosim.org/me/models/crate/1/meshes/a.stl", "");
  const std::vector<std::filesystem::path> caches = model_places("").fuel;
  ASSERT_EQ(caches.size(), 1U);
  const auto found =
      find_downloaded("fuel.gazebosim.org/1.0/Me/models/Crate/1/files/meshes/a.stl", caches);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->filename(), "a.stl");
  EXPECT_FALSE(find_downloaded("fuel.gazebosim.org/1.0/Me/models/Crate/1/files/b.stl", caches));
  EXPECT_FALSE(find_downloaded("models/crate", caches));
  EXPECT_FALSE(find_downloaded("", caches));
}

}  // namespace
}  // namespace navvi_sim::read
