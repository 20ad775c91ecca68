// coverage STUDY HELD_OUT [FIGURE...]: how many cases that a study does not hold are within its stated
// errors.
#include <cstdio>

#include "base/command/command.h"
#include "base/quantiles.h"
#include "explorer/analysis/figure_model.h"

using namespace cleft;

int main(int argc, char** argv) {
  CommandLine app("Counts the cases of a study that lie within the errors that another states.", "coverage");
  std::string study, held;
  std::vector<std::string> texts = {"gape", "gape(0)", "displacement", "v(0, 6, 0)"};
  app.add_option("STUDY", study, "the study that answers")->required();
  app.add_option("HELD_OUT", held, "cases that it is asked for")->required();
  app.add_option("FIGURES", texts, "figures");
  return run_command(app, argc, argv, [&] {
    std::vector<Figure> figures(texts.begin(), texts.end());
    const FigureModel model(PublishedStudy(study), figures);
    const PublishedStudy others(held);
    Eigen::MatrixXd points(std::ssize(model.varying()), others.size()),
        truth(std::ssize(figures), others.size());
    for (int j = 0; j < others.size(); ++j) {
      const Field field = others.read(j);
      for (Eigen::Index k = 0; k < points.rows(); ++k)
        points(k, j) = field.parameters.number(model.varying()[static_cast<std::size_t>(k)].name).value();
      for (std::size_t f = 0; f < figures.size(); ++f)
        truth(static_cast<Eigen::Index>(f), j) = figures[f].of(field);
    }
    const FigureModel::Answers answers = model.at(points);
    std::printf("%d cases, %s\n", model.cases(), model.method().c_str());
    for (Eigen::Index f = 0; f < truth.rows(); ++f) {
      const double scale = truth.row(f).cwiseAbs().maxCoeff();
      const Eigen::RowVectorXd off = (answers.values - truth).row(f).cwiseAbs() / scale,
                               stated = answers.errors.row(f) / scale;
      const auto quantiles = [](const Eigen::RowVectorXd& row, double part) {
        return quantile({row.begin(), row.end()}, part);
      };
      std::printf(
          "%-14s within %3d of %d   error: median %.5f, 95 %% %.5f   stated: median %.5f, 95 %% %.5f\n",
          figures[static_cast<std::size_t>(f)].text().c_str(),
          static_cast<int>((off.array() <= stated.array()).count()), others.size(), quantiles(off, 0.5),
          quantiles(off, 0.95), quantiles(stated, 0.5), quantiles(stated, 0.95));
    }
  });
}
