// The picture, by gnuplot: panels in rows of three, series labelled next to their lines.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "base/memory_file.h"
#include "base/output_file.h"
#include "base/output_folder.h"
#include "base/process.h"
#include "base/text.h"
#include "tradeoff/chart.h"

namespace cleft {

namespace {

constexpr int panels_a_row = 3, panel_width = 520, panel_height = 430, heading_height = 70;
constexpr double axes_width = 410, axes_height = 325;  // about, of a panel

/// Okabe and Ito's colours, which colour-blind people can distinguish.
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

  /// 0 at the least, 1 at the most.
  double part(double value, bool logarithmic) const {
    return logarithmic ? std::log(value / least) / std::log(most / least) : (value - least) / (most - least);
  }
};

/// Pixels of a panel, from its axes' corner.
struct Box {
  double left, right, bottom, top;

  bool holds(const std::array<double, 2>& p) const {
    return p[0] > left && p[0] < right && p[1] > bottom && p[1] < top;
  }
  bool meets(const Box& other) const {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
  bool covers(const Box& other) const {
    return other.left >= left && other.right <= right && other.bottom >= bottom && other.top <= top;
  }
  Box grown(double by) const { return {left - by, right + by, bottom - by, top + by}; }
};

/// Of a series, in pixels, every few of them.
std::vector<std::array<double, 2>> along_line(const std::vector<std::array<double, 2>>& points) {
  constexpr double spacing = 4;
  std::vector<std::array<double, 2>> all(points.begin(), points.begin() + 1);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto [x0, y0] = points[i - 1];
    const double dx = points[i][0] - x0, dy = points[i][1] - y0;
    const int steps = 1 + static_cast<int>(std::hypot(dx, dy) / spacing);
    for (int k = 1; k <= steps; ++k) all.push_back({x0 + dx * k / steps, y0 + dy * k / steps});
  }
  return all;
}

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
    out += ranges();
    out += series();
    out += names();
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
      for (auto& [x, y] : rows)
        x = axes_width * x_.part(x, chart_.log_x), y = axes_height * y_.part(y, chart_.log_y);
      const auto way = along_line(rows);
      std::sort(rows.begin(), rows.end());
      lines_.push_back({names[n], color, rows, way});
    }
    return out;
  }

  /// Each is next to a point of its line, where it hides least and is nearest to its own line.
  std::string names() {
    constexpr double letter = 8, half = 8, beside = 9, above = 14;
    std::string out;
    constexpr Box inside{0, axes_width, half, axes_height};
    std::vector<Box> taken;
    for (const Line& line : lines_) {
      const double width = letter * static_cast<double>(line.name.size());
      double least = 0;
      std::optional<Box> best;
      for (const auto& [x, y] : line.points)
        for (const double up : {above, -above, 0.})
          for (const double left : {x + beside, x - beside - width}) {
            const Box box{left, left + width, y + up - half, y + up + half};
            double hidden = inside.covers(box) ? 0 : 1000;
            for (const Box& other : taken) hidden += box.meets(other) ? 1000 : 0;
            for (const Line& other : lines_)
              for (const auto& p : other.way)
                hidden += box.holds(p) ? 3 : &other != &line && box.grown(above).holds(p) ? 1 : 0;
            if (!best || hidden < least) best = box, least = hidden;
          }
      taken.push_back(*best);
      out += "set label " + std::to_string(taken.size()) + " " + quoted(line.name) + " at graph " +
             shortest(best->left / axes_width) + "," + shortest((best->bottom + half) / axes_height) +
             " left tc rgb '" + line.color + "' noenhanced\n";
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
  struct Line {
    std::string name, color;
    std::vector<std::array<double, 2>> points, way;  // pixels; the way: all along it
  };
  std::vector<Line> lines_;
};

/// gnuplot does not tell of a full disk: it writes to files in memory.
struct ChartFiles {
  MemoryFile svg, png;
};

std::string script_of(const std::vector<Chart>& charts, const std::string& heading,
                      const std::string& caption, const ChartFiles& files) {
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
  return "set terminal svg size " + size + " font " + font + " background '#ffffff'\nset output '" +
         files.svg.path() + "'\n" + common + page + "set terminal pngcairo size " + size + " font " + font +
         "\nset output '" + files.png.path() + "'\n" + page;
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
  const ChartFiles files;
  write_text_file(in("chart.gp"), script_of(charts, heading, caption, files));
  ProcessResult result;
  try {
    result = run_process({"/bin/sh", "-c", "cd \"$0\" && exec gnuplot chart.gp", out.path()}, in("log"), {});
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(std::string("gnuplot: ") + e.what());
  }
  if (result.exit_code == 127) throw std::runtime_error("gnuplot is missing: install Debian's gnuplot-nox");
  if (!result.success()) throw std::runtime_error("gnuplot failed: " + read_text_file(in("log")));
  files.svg.copy_to(in(name + ".svg")), files.png.copy_to(in(name + ".png"));
  out.commit({name + ".svg", name + ".png"});
}

}  // namespace cleft
