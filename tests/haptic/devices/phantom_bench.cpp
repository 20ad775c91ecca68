// A PHANToM whose driver is the stub next to it.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "haptic/devices/phantom.h"
#include "tests/haptic/devices/bench.h"

namespace cleft::testing {

namespace {

class Arm : public Bench {
 public:
  Arm() : stub_(dlopen(CLEFT_STUB_HD, RTLD_NOW)) {
    EXPECT_TRUE(stub_) << dlerror();
    find(target_, "stub_target"), find(buttons_, "stub_buttons"), find(plug_, "stub_plug"),
        find(force_, "stub_force");
    push(0);
    press(false);
    plug_(1);
  }
  ~Arm() override { dlclose(stub_); }
  std::unique_ptr<Device> open(const ScalpelPose& start) override {
    return std::make_unique<Phantom>(start, CLEFT_STUB_HD);
  }
  void push(double part) override { target_(10 * part, 50, 10); }  // about the middle of its workspace
  void press(bool down) override { buttons_(down); }
  void plug() override { plug_(1); }
  void unplug() override { plug_(0); }
  double felt() override {
    double force[3];
    force_(force);
    return force[1];  // up
  }
  std::string remedy() const override { return "plug it in"; }

 private:
  template <class Function>
  void find(Function*& function, const char* name) {
    function = reinterpret_cast<Function*>(dlsym(stub_, name));
    ASSERT_TRUE(function) << name;
  }
  void* stub_;
  void (*target_)(double, double, double);
  void (*buttons_)(int);
  void (*plug_)(int);
  void (*force_)(double*);
};

}  // namespace

std::unique_ptr<Bench> phantom_bench() { return std::make_unique<Arm>(); }

TEST(Phantom, NamesWhatToInstall) {
  try {
    Phantom phantom({}, "libHD-that-nobody-has.so");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("install OpenHaptics"), std::string::npos) << e.what();
  }
}

TEST(Phantom, AsksForCalibration) {
  void* stub = dlopen(CLEFT_STUB_HD, RTLD_NOW);
  const auto calibrated = reinterpret_cast<void (*)(int)>(dlsym(stub, "stub_calibrated"));
  calibrated(0);
  EXPECT_THROW(Phantom({}, CLEFT_STUB_HD), InputError);
  calibrated(1);
  dlclose(stub);
}

TEST(Phantom, LimitsAreTheDevices) {
  const Phantom phantom({}, CLEFT_STUB_HD);
  EXPECT_EQ(phantom.limits().max_force, 3.3);
  EXPECT_EQ(phantom.limits().max_stiffness, 0.7);
  EXPECT_EQ(phantom.limits().max_damping, 0.005);
}

}  // namespace cleft::testing
