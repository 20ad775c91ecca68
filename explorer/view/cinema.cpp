#include "explorer/view/cinema.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "base/output_file.h"
#include "base/text.h"
#include "explorer/view/camera_shot.h"

namespace cleft {

namespace {

std::string header(const PublishedStudy& study) {
  std::string line = "case";
  for (const std::string& name : study.varying()) line += "," + name;
  return line + ",length_cut,azimuth,elevation,gape,displacement,FILE\n";
}

std::string values(Session& session, int i) {
  std::string line = std::to_string(i + 1);
  for (const std::string& name : session.study()->varying())
    line += "," + shortest(session.column_value(i, name));
  return line;
}

}  // namespace

CinemaFigures write_cinema(Session& session, const std::string& out, const CinemaGrid& grid,
                           const std::function<void(int done, int of)>& progress) {
  const int cases = session.open_study().size();
  const int all = cases * grid.times * static_cast<int>(grid.cameras.size());
  std::filesystem::create_directory(out + "/images");
  std::string table = header(*session.study());
  CinemaFigures done;
  CameraShot shot(grid.width, grid.height);
  for (; done.cases < cases; ++done.cases) {
    session.say("case " + std::to_string(done.cases + 1));
    const auto field = session.field();
    for (int j = 0; j < grid.times; ++j) {
      const double t = session.duration() * j / std::max(1, grid.times - 1);
      session.say("time " + shortest(t));
      const std::string gape = shortest(widest_gape(*field, t));
      for (std::size_t k = 0; k < grid.cameras.size(); ++k) {
        progress(done.pictures, all);
        const auto [azimuth, elevation] = grid.cameras[k];
        session.say("camera " + shortest(azimuth) + " " + shortest(elevation));
        char name[80];
        std::snprintf(name, sizeof name, "images/case%04d_t%03d_camera%zu.png", done.cases + 1, j, k);
        write_png(shot.take(session), out + "/" + name, state_to_json(session.state()));
        table += values(session, done.cases) + "," + shortest(t) + "," + shortest(azimuth) + "," +
                 shortest(elevation) + "," + gape + "," + shortest(field->report.largest_displacement) + "," +
                 name + "\n";
        ++done.pictures;
      }
    }
  }
  write_text_file(out + "/data.csv", table);
  return done;
}

}  // namespace cleft
