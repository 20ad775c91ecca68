// The picture, by gnuplot: panels in rows of three, series labelled at their ends.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "base/output_file.h"
#include "base/output_folder.h"
#include "base/process.h"
#include "base/text.h"
#include "tradeoff/chart.h"

namespace cleft {

namespace {

constexpr int panels_a_row = 3, panel_width = 520, panel_height = 430, heading_height = 70;

/// Okabe and Ito's colours, which the colour-blind tell apart.
constexpr std::array<const char*, 6> colors = {"#0072B2", "#D55E00", "#009E73",
                                               "#CC79A7", "#E69F00", "#56B4E9"};

std::vector<std::string> series_of(const Chart& chart) {
  std::vector<std::string> names;
  for (const ChartPoint& p : chart.points)
    if (std::find(names.begin(), names.end(), p.series) == names.end()) names.push_back(p.series);
  return names;
}

/// Text between double quotes.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

struct Range1D {
  double least, most;
};

/// With room for the labels at the ends of lines.
Range1D padded(double least, double most, bool logarithmic, double left, double right) {
  if (logarithmic) {
    const double decades = std::max(std::log10(most / least), 0.5);
    return {least * std::pow(10, -left * decades), most * std::pow(10, right * decades)};
  }
  const double span = most > least ? most - least : std::max(1.0, std::abs(most));
  return {least - left * span, most + right * span};
}

/// A value that an axis can show: nothing, where it is logarithmic and the value is not positive.
bool drawable(const Chart& chart, const ChartPoint& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && !(chart.log_x && p.x <= 0) && !(chart.log_y && p.y <= 0);
}

std::string block(const std::string& name, const std::vector<std::array<double, 2>>& rows) {
  std::string text = name + " << EOD\n";
  for (const auto& [x, y] : rows) text += shortest(x) + " " + shortest(y) + "\n";
  return text + "EOD\n";
}

/// The commands that draw one panel.
class PanelScript {
 public:
  PanelScript(const Chart& chart, int number) : chart_(chart), prefix_("$panel" + std::to_string(number)) {}

  std::string text() {
    for (const ChartPoint& p : chart_.points)
      if (drawable(chart_, p)) drawn_.push_back(p);
    std::string out = "unset label\nunset logscale\nset format x '%g'\nset format y '%g'\n";
    out += "set title " + quoted(chart_.title) + "\nset xlabel " + quoted(chart_.x_label) + "\nset ylabel " +
           quoted(chart_.y_label) + "\n";
    if (drawn_.empty())
      return out + "set label 1 'nothing measured' at graph 0.5,0.5 center\nplot [0:1][0:1] NaN notitle\n";
    if (chart_.log_x) out += "set logscale x\n";
    if (chart_.log_y) out += "set logscale y\n";
    out += ranges();  // names of series are placed within them
    out += series();
    out += front();
    out += standard();
    return out + "plot " + plots_ + "\n";
  }

 private:
  std::string ranges() {
    x_ = {drawn_[0].x, drawn_[0].x}, y_ = {drawn_[0].y, drawn_[0].y};
    for (const ChartPoint& p : drawn_) {
      x_ = {std::min(x_.least, p.x), std::max(x_.most, p.x)};
      y_ = {std::min(y_.least, p.y), std::max(y_.most, p.y)};
    }
    x_ = padded(x_.least, x_.most, chart_.log_x, 0.06, 0.3),
    y_ = padded(y_.least, y_.most, chart_.log_y, 0.08, 0.12);
    return tics("x", chart_.log_x, x_) + tics("y", chart_.log_y, y_) + "set xrange [" + shortest(x_.least) +
           ":" + shortest(x_.most) + "]\nset yrange [" + shortest(y_.least) + ":" + shortest(y_.most) + "]\n";
  }

  /// Above a series' first point, or below where another's name stands there.
  double label_offset(const std::array<double, 2>& at) {
    const auto part = [](double value, const Range1D& range, bool logarithmic) {
      return logarithmic ? std::log(value / range.least) / std::log(range.most / range.least)
                         : (value - range.least) / (range.most - range.least);
    };
    const std::array<double, 2> place{part(at[0], x_, chart_.log_x), part(at[1], y_, chart_.log_y)};
    const bool taken = std::any_of(labels_.begin(), labels_.end(), [&](const std::array<double, 2>& other) {
      return std::abs(other[0] - place[0]) < 0.3 && std::abs(other[1] - place[1]) < 0.06;
    });
    labels_.push_back(place);
    return taken ? -0.8 : 0.7;
  }

  /// On a logarithmic axis of few decades 1, 2 and 5 of each, of less than one more; gnuplot would label the
  /// powers of ten alone.
  static std::string tics(const std::string& axis, bool logarithmic, const Range1D& range) {
    if (!logarithmic || range.most / range.least > 300) return "set " + axis + "tics autofreq\n";
    const std::vector<int> tenths =
        range.most / range.least > 8 ? std::vector{10, 20, 50} : std::vector{10, 15, 20, 30, 40, 50, 70};
    std::string list;
    for (int power = static_cast<int>(std::floor(std::log10(range.least))); std::pow(10, power) < range.most;
         ++power)
      for (const int digits : tenths) {
        const std::string number = shortest_of(digits, power - 1);
        list += (list.empty() ? "'" : ", '") + number + "' " + number;
      }
    return "set " + axis + "tics (" + list + ")\n";
  }
  static std::string shortest_of(int digits, int power) {
    return shortest(power < 0 ? digits / std::pow(10, -power) : digits * std::pow(10, power));
  }

  void plot(const std::string& what) { plots_ += (plots_.empty() ? "" : ", ") + what; }

  std::string series() {
    std::string out;
    const std::vector<std::string> names = series_of(chart_);
    for (std::size_t n = 0; n < names.size(); ++n) {
      std::vector<std::array<double, 2>> rows;
      for (const ChartPoint& p : drawn_)
        if (p.series == names[n]) rows.push_back({p.x, p.y});
      if (rows.empty()) continue;
      const std::string data = prefix_ + "_" + std::to_string(n), color = colors[n % colors.size()];
      out += block(data, rows);
      plot(data + " with linespoints pt 7 ps 0.8 lw 1.5 lc rgb '" + color + "' notitle");
      const auto first = *std::min_element(rows.begin(), rows.end());
      out += "set label " + std::to_string(n + 1) + " " + quoted(names[n]) + " at " + shortest(first[0]) +
             "," + shortest(first[1]) + " left offset 0.6," + shortest(label_offset(first)) + " tc rgb '" +
             color + "' noenhanced\n";
    }
    return out;
  }

  std::string front() {
    if (!chart_.front) return "";
    Chart shown = chart_;
    shown.points = drawn_;
    std::vector<std::array<double, 2>> rows;
    for (const std::size_t i : pareto_front(shown)) rows.push_back({drawn_[i].x, drawn_[i].y});
    plot(prefix_ + "_front with points pt 6 ps 1.7 lw 1.2 lc rgb '#000000' notitle");
    return block(prefix_ + "_front", rows);
  }

  std::string standard() {
    std::vector<std::array<double, 2>> rows;
    for (const ChartPoint& p : drawn_)
      if (p.standard) rows.push_back({p.x, p.y});
    if (rows.empty()) return "";
    plot(prefix_ + "_standard with points pt 3 ps 1.8 lw 1.6 lc rgb '#000000' notitle");
    return block(prefix_ + "_standard", rows);
  }

  const Chart& chart_;
  std::string prefix_, plots_;
  std::vector<ChartPoint> drawn_;
  Range1D x_{}, y_{};
  std::vector<std::array<double, 2>> labels_;  // where they stand, in parts of the panel
};

std::string script_of(const std::vector<Chart>& charts, const std::string& heading,
                      const std::string& caption) {
  const int rows = (static_cast<int>(charts.size()) + panels_a_row - 1) / panels_a_row,
            columns = std::min(panels_a_row, static_cast<int>(charts.size()));
  const int width = columns * panel_width, height = rows * panel_height + heading_height;
  const std::string size = std::to_string(width) + "," + std::to_string(height), font = "'DejaVu Sans,11'";
  std::string panels;
  for (std::size_t i = 0; i < charts.size(); ++i)
    panels += PanelScript(charts[i], static_cast<int>(i)).text();
  const std::string title =
      heading + "\\n{/*0.75 " + caption + "}\\n{/*0.75 rings: the Pareto front, star: the default}";
  const std::string page = "set multiplot layout " + std::to_string(rows) + "," + std::to_string(columns) +
                           " title \"" + title + "\"\n" + panels + "unset multiplot\nunset output\n";
  const std::string common =
      "set encoding utf8\nset grid lc rgb '#dddddd' lw 0.6\nset border 3\nset tics nomirror\nunset key\n"
      "set lmargin 10\nset rmargin 2\n";
  return "set terminal svg size " + size + " font " + font +
         " background '#ffffff'\nset output 'chart.svg'\n" + common + page + "set terminal pngcairo size " +
         size + " font " + font + "\nset output 'chart.png'\n" + page;
}

}  // namespace

void draw_charts(const std::vector<Chart>& charts, const std::string& stem, const std::string& heading,
                 const std::string& caption) {
  namespace fs = std::filesystem;
  const fs::path path(stem);
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".",
                    name = path.filename();
  OutputFolder out(folder, name);
  const auto in = [&](const std::string& file) { return out.path() + "/" + file; };
  write_text_file(in("chart.gp"), script_of(charts, heading, caption));
  ProcessResult result;
  try {
    result = run_process({"/bin/sh", "-c", "cd \"$0\" && exec gnuplot chart.gp", out.path()}, in("log"), {});
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(std::string("gnuplot: ") + e.what());
  }
  if (result.exit_code == 127) throw std::runtime_error("gnuplot is missing: install Debian's gnuplot-nox");
  if (!result.success()) throw std::runtime_error("gnuplot failed: " + read_text_file(in("log")));
  for (const char* ending : {".svg", ".png"})
    fs::rename(in(std::string("chart") + ending), in(name + ending));
  out.commit({name + ".svg", name + ".png"});
}

}  // namespace cleft
