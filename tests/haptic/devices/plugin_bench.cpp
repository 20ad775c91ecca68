// The sample plug-in as a device, found in its folder; and messages about plug-ins that cannot be used.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/error.h"
#include "base/process.h"
#include "haptic/devices/list.h"
#include "haptic/devices/plugins.h"
#include "tests/haptic/devices/bench.h"
#include "tests/support/temporary_folder.h"

namespace cleft::testing {

namespace {

namespace fs = std::filesystem;

class PluginArm : public Bench {
 public:
  PluginArm() : library_(dlopen(CLEFT_PLUGINS "/bench.so", RTLD_NOW)) {
    setenv("CLEFT_DEVICES", CLEFT_PLUGINS, 1);
    EXPECT_TRUE(library_) << dlerror();
    find(push_, "bench_push"), find(press_, "bench_press"), find(plug_, "bench_plug"),
        find(felt_, "bench_felt");
    push_(0), press_(0), plug_(1);
  }
  ~PluginArm() override { dlclose(library_); }
  std::unique_ptr<Device> open(const ScalpelPose& start) override {
    DeviceRequest request;
    request.start = start;
    return make_device("bench", request);
  }
  void push(double part) override { push_(part); }
  void press(bool down) override { press_(down); }
  void plug() override { plug_(1); }
  void unplug() override { plug_(0); }
  double felt() override { return felt_(); }
  std::string remedy() const override { return "bench: the arm is not there: plug the bench in"; }

 private:
  template <class Function>
  void find(Function*& function, const char* name) {
    function = reinterpret_cast<Function*>(dlsym(library_, name));
    ASSERT_TRUE(function) << name;
  }
  void* library_;
  void (*push_)(double);
  void (*press_)(int);
  void (*plug_)(int);
  double (*felt_)();
};

class Plugins : public ::testing::Test {
 protected:
  Plugins() { setenv("CLEFT_DEVICES", (folder / "").c_str(), 1); }
  ~Plugins() override { unsetenv("CLEFT_DEVICES"); }
  void add(const char* built, const std::string& name) {
    fs::copy_file(std::string(CLEFT_PLUGINS) + "/" + built, folder / name);
  }
  /// Why the device cannot be had; the sheet must say the same.
  std::string refusal(const std::string& name) {
    try {
      make_device(name, {});
    } catch (const InputError& e) {
      EXPECT_NE(device_sheet().find(e.what()), std::string::npos) << device_sheet();
      return e.what();
    }
    return "";
  }
  TemporaryFolder folder;
};

TEST_F(Plugins, AreFoundInTheFoldersOfTheVariableAndNextToTheProgram) {
  setenv("CLEFT_DEVICES", "/a::/b/", 1);
  const auto folders = plugin_folders();
  ASSERT_EQ(folders.size(), 3u);
  EXPECT_EQ(folders[0], "/a");
  EXPECT_EQ(fs::path(folders[1]), fs::path("/b/"));
  EXPECT_EQ(fs::path(folders[2]),
            (fs::path(executable_folder()).parent_path() / "lib/cleft/devices").lexically_normal());
}

TEST_F(Plugins, AreListedWithTheirHelpAndTheirFile) {
  add("bench.so", "bench.so");
  const std::string sheet = device_sheet();
  EXPECT_NE(sheet.find("an arm that tests pretend (" + folder / "bench.so" + ")"), std::string::npos)
      << sheet;
  EXPECT_EQ(sheet.find("cannot be used"), std::string::npos) << sheet;
  for (const DeviceKind& kind : built_in_devices())
    EXPECT_NE(sheet.find(kind.help), std::string::npos) << kind.name;
  EXPECT_EQ(find_device("bench").title, "The &bench's arm");
}

TEST_F(Plugins, OfAnotherVersionAreRefusedWithTheRemedy) {
  add("later.so", "later.so");
  const std::string why = refusal("later");
  EXPECT_NE(why.find("version 2 of the device interface, and this program has version 1"), std::string::npos)
      << why;
  EXPECT_NE(why.find("later.so"), std::string::npos) << why;
}

TEST_F(Plugins, WithoutTheEntryPointAreRefused) {
  add("without_entry.so", "without_entry.so");
  EXPECT_NE(refusal("without_entry").find("has no function cleft_device"), std::string::npos);
}

TEST_F(Plugins, ThatAreNoLibrariesAreRefused) {
  folder.write("torn.so",
               "\x7f"
               "ELF, and no more");
  EXPECT_NE(refusal("torn").find("torn.so cannot be loaded"), std::string::npos);
}

TEST_F(Plugins, MustHaveTheNameOfTheirFileAndOfNoOtherDevice) {
  add("bench.so", "other.so");
  EXPECT_NE(refusal("other").find("names itself 'bench'"), std::string::npos);
  add("bench.so", built_in_devices().front().name + ".so");
  EXPECT_NE(device_sheet().find("has the name of a device above"), std::string::npos);
  EXPECT_EQ(find_device(built_in_devices().front().name).file, "");
}

TEST_F(Plugins, PosesThatAreNoneAreAnUnpluggedDevice) {
  PluginArm arm;
  const auto device = arm.open({});
  EXPECT_TRUE(device->read(0).present);
  arm.push(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(device->read(1e-3), absent());
  arm.push(1);
  EXPECT_EQ(device->read(1).tip, (Vec3{10, 0, 0}));
}

TEST_F(Plugins, AreNamedWhereADeviceIsNot) {
  add("bench.so", "bench.so");
  try {
    make_device("bensh", {});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean 'bench'"), std::string::npos) << e.what();
  }
}

}  // namespace

std::unique_ptr<Bench> plugin_bench() { return std::make_unique<PluginArm>(); }

}  // namespace cleft::testing
