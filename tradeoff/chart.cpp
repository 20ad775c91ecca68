#include "tradeoff/chart.h"

#include <algorithm>
#include <numeric>

#include "base/text.h"

namespace cleft {

std::vector<std::size_t> pareto_front(const Chart& chart) {
  std::vector<std::size_t> order(chart.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const ChartPoint &p = chart.points[a], &q = chart.points[b];
    return p.x != q.x ? p.x < q.x : p.y < q.y;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || chart.points[i].y < chart.points[front.back()].y) front.push_back(i);
  return front;
}

namespace {

std::string csv_cell(const std::string& text) {
  return text.find(',') == text.npos ? text : '"' + text + '"';
}

}  // namespace

std::string csv_of(const std::vector<Chart>& charts) {
  std::string text = "chart,series,setting,x,x_label,y,y_label,standard,front\n";
  for (const Chart& chart : charts) {
    std::vector<bool> on_front(chart.points.size());
    if (chart.front)
      for (const std::size_t i : pareto_front(chart)) on_front[i] = true;
    for (std::size_t i = 0; i < chart.points.size(); ++i) {
      const ChartPoint& p = chart.points[i];
      text += chart.name + "," + csv_cell(p.series) + "," + csv_cell(p.setting) + "," + shortest(p.x) + "," +
              csv_cell(chart.x_label) + "," + shortest(p.y) + "," + csv_cell(chart.y_label) +
              (p.standard ? ",1" : ",0") + (on_front[i] ? ",1\n" : ",0\n");
    }
  }
  return text;
}

}  // namespace cleft
