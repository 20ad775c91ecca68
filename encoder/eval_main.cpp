// cleft eval: displacements of a field at points given as CSV.
#include <iostream>

#include "base/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "encoder/field/field_file.h"

using namespace cleft;

namespace {

constexpr const char* columns[] = {"u", "v", "w", "side", "t"};

/// A number of a row inside the field's domain; the field itself would clamp without a word.
double inside(const Field& field, int axis, double value, const std::string& where) {
  const auto [front, back] = field.domain(axis);
  const double slack = 1e-9 * (back - front);
  if (value >= front - slack && value <= back + slack) return value;
  throw InputError(where + ": " + columns[axis == 3 ? 4 : axis] + " = " + shortest(value) +
                   ": the field reaches from " + shortest(front) + " to " + shortest(back) + " mm");
}

std::string evaluate_rows(const Field& field, const NumberTable& table, const std::string& file) {
  int at[5];
  for (int c = 0; c < 5; ++c) {
    at[c] = table.column(columns[c]);
    if (at[c] < 0)
      throw FileError(file,
                      std::string("column '") + columns[c] + "' is missing; the columns are u,v,w,side,t");
  }
  std::string text = "du,dv,dw\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& row = table.rows[r];
    const std::string where = file + ", row " + std::to_string(r + 1);
    const double side = row[at[3]];
    if (side != -1 && side != 0 && side != 1)
      throw InputError(where + ": side = " + shortest(side) +
                       ": must be -1 (left), 1 (right) or 0 (by the sign of v)");
    const Vec3 uvw{inside(field, 0, row[at[0]], where), inside(field, 1, row[at[1]], where),
                   inside(field, 2, row[at[2]], where)};
    if (uvw.y * side < 0)
      throw InputError(where + ": side = " + shortest(side) + " contradicts v = " + shortest(uvw.y));
    const Vec3 d = field.displacement(uvw, static_cast<Side>(static_cast<int>(side)),
                                      inside(field, 3, row[at[4]], where));
    text += shortest(d.x) + "," + shortest(d.y) + "," + shortest(d.z) + "\n";
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Displacements (mm, from the closed frame) of a field at points.", "cleft eval");
  std::string file, points = "/dev/stdin", out;
  app.add_option("CASE.dffd", file, "field")->required();
  app.add_option("--points", points,
                 "CSV with columns u,v,w,side,t in mm; side -1 left, 1 right, 0 by the sign of v")
      ->capture_default_str();
  app.add_option("--out", out, "CSV to write, columns du,dv,dw (default: standard output)");
  return run_command(app, argc, argv, [&] {
    refuse_to_overwrite(out, {file, points});
    const Field field = read_field(file);
    const std::string text = evaluate_rows(field, read_csv(points), points);
    if (out.empty())
      std::cout << text;
    else
      write_text_file(out, text);
  });
}
