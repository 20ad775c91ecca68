// A session over a study of four cases and a plate to cut, made on the spot.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "base/output_file.h"
#include "encoder/field/file/field_file.h"
#include "explorer/session/session.h"
#include "tests/support/flat_plate.h"
#include "tests/support/recorded.h"
#include "tests/support/temporary_folder.h"
#include "tests/view/synthetic_field.h"

namespace cleft {

/// A folder with the study, made once: tests only read it.
inline const std::string& shared_study() {
  static const TemporaryFolder folder;
  static const std::string study = [] {
    int number = 0;
    for (const double gape : {2., 5.})
      for (const double modulus : {0.01, 0.04}) {
        const std::string name = "case" + std::to_string(number++);
        const std::string place = folder / ("study/cases/" + name);
        std::filesystem::create_directories(place);
        Field field = synthetic_field(gape + 10 * modulus);
        field.parameters = recorded({{"skin.prestress_v", gape / 100},
                                     {"tissue.young_modulus", modulus},
                                     {"cut.depth", 6},
                                     {"skin.thickness", 1.5},
                                     {"skin.young_modulus", 0.5},
                                     {"skin.poisson_ratio", 0.4},
                                     {"tissue.poisson_ratio", 0.45}});
        field.case_hash = name;
        write_field(place + "/case.dffd", field);
        write_text_file(place + "/manifest.json", "{}");
      }
    return folder / "study";
  }();
  return study;
}

/// Three cases that differ in the skin's prestress alone, whose fields superpose.
inline void write_study_of_prestresses(const std::string& study) {
  int number = 0;
  const std::vector<Vec3> prestresses{{0.01, 0.03, 0}, {0.02, 0.01, 0}, {0.01, 0.01, 0.005}};
  for (const Vec3& p : prestresses) {
    const std::string place = study + "/cases/case" + std::to_string(number);
    std::filesystem::create_directories(place);
    Field field = synthetic_field(500 / 3. * p.y);  // the tension across opens it
    field.parameters = recorded({{"skin.prestress_u", p.x},
                                 {"skin.prestress_v", p.y},
                                 {"skin.prestress_uv", p.z},
                                 {"skin.thickness", 1.5},
                                 {"skin.young_modulus", 0.5},
                                 {"skin.poisson_ratio", 0.4},
                                 {"tissue.young_modulus", 0.01},
                                 {"tissue.poisson_ratio", 0.45}});
    field.case_hash = "case" + std::to_string(number++);
    write_field(place + "/case.dffd", field);
    write_text_file(place + "/manifest.json", "{}");
  }
}

class SessionTest : public testing::Test {
 protected:
  /// The largest way of any point.
  static double widest(const std::vector<Vec3>& points, const std::vector<Vec3>& rest) {
    double largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) largest = std::max(largest, norm(points[i] - rest[i]));
    return largest;
  }
  static const std::string& study() { return shared_study(); }
  void say(const std::string& line) { session_.say(line); }
  void open() { say("open " + study()); }
  void cut_plate() {
    open();
    say("mesh plate.stl");
    say("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  }
  const SessionState& state() const { return session_.state(); }
  /// Of the error that a line gives; empty where it gives none.
  std::string refused(const std::string& line) {
    try {
      session_.say(line);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  std::vector<Vec3> points() {
    std::vector<Vec3> out;
    session_.scene()->positions(state().time, out);
    return out;
  }

  /// Of another session that knows the plate, without pictures.
  static SessionServices session_services_of_plate() {
    SessionServices services;
    services.read_mesh = [](const std::string&) { return flat_plate(); };
    services.answer = [](const std::string&) {};
    return services;
  }

  TemporaryFolder folder_;
  std::string answers_, written_;
  SurfaceMesh exported_;
  Session session_{{[](const std::string& file) {
                      if (!file.ends_with("plate.stl")) throw FileError(file, "no such file");
                      SurfaceMesh plate = flat_plate();
                      if (file.ends_with("bone_plate.stl"))
                        for (Vec3& x : plate.points) x.z -= 6;
                      if (file.ends_with("painted_plate.stl"))
                        for (const Vec3& x : plate.points)
                          plate.colors.push_back({static_cast<float>(0.5 + 0.01 * x.x), 0.25F, 0.75F});
                      return plate;
                    },
                    [this](const std::string&, const SurfaceMesh& mesh) { exported_ = mesh; },
                    [this](Session& s, const std::string& file, int width, int height, bool) {
                      written_ = file + " " + std::to_string(width) + "x" + std::to_string(height);
                      picture_state_ = state_to_json(s.state());
                    },
                    [this](const std::string&) { return picture_state_; },
                    [this](const std::string& text) { answers_ += text + "\n"; }}};
  std::string picture_state_;
};

}  // namespace cleft
