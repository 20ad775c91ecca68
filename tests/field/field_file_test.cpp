#include "encoder/field/file/field_file.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>

#include "base/error.h"
#include "base/file_versions.h"
#include "base/h5/h5.h"
#include "base/text.h"
#include "encoder/field/file/field_record.h"
#include "tests/field/random_field.h"
#include "tests/support/damage.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

bool same(const Field& a, const Field& b) {
  for (int axis = 0; axis < 4; ++axis)
    if (a.basis(axis).knots() != b.basis(axis).knots() || a.basis(axis).degree() != b.basis(axis).degree())
      return false;
  return a.coefficients() == b.coefficients() && a.parameters == b.parameters && a.case_hash == b.case_hash &&
         a.cut().start == b.cut().start && a.cut().length == b.cut().length &&
         a.cut().depth == b.cut().depth && a.report.node_error == b.report.node_error &&
         a.quantum == b.quantum && a.parametrization().name() == b.parametrization().name() &&
         a.parametrization().geometry().tip.positions == b.parametrization().geometry().tip.positions;
}

NodeResidual random_residual() {
  NodeResidual residual{0.003, 50, 7, SmallIntegers(50 * 3 * 7)};
  std::mt19937 random(4);
  for (std::size_t i = 0; i < residual.values.size(); ++i)
    if (random() % 4 == 0) residual.values.set(i, static_cast<int>(random() % 5) - 2);
  return residual;
}

}  // namespace

TEST(FieldFile, ReadsBackWhatWasWritten) {
  for (const Field& field : {random_field(), following_field()}) {
    const TemporaryFolder folder;
    write_field(folder / "a.dffd", field);
    EXPECT_TRUE(same(read_field(folder / "a.dffd"), field));
    EXPECT_EQ(read_field_parameters(folder / "a.dffd"), field.parameters);
    EXPECT_FALSE(read_residual(folder / "a.dffd"));
    EXPECT_EQ(folder.entries(), 1);
  }
}

TEST(FieldFile, TheTissueBelowTheCutComesBack) {
  const TemporaryFolder folder;
  Field field = random_field();
  field.tissue = TissueBelow{{{0.08, 0.4, 1.2}, {0.012, 0.45, 4.8}}, 0.005};
  write_field(folder / "a.dffd", field);
  const std::optional<TissueBelow> found = read_field(folder / "a.dffd").tissue;
  ASSERT_TRUE(found && found->layers.size() == 2);
  EXPECT_EQ(found->foundation, 0.005);
  for (int i : {0, 1}) {
    const TissueLayerBelow &layer = found->layers[i], &written = field.tissue->layers[i];
    EXPECT_EQ(layer.young_modulus, written.young_modulus);
    EXPECT_EQ(layer.poisson_ratio, written.poisson_ratio);
    EXPECT_EQ(layer.height, written.height);
  }
}

TEST(FieldFile, TellsItsModelAndAFileWithoutOneIsOfSmallStrains) {
  const TemporaryFolder folder;
  Field field = random_field();
  write_field(folder / "older.dffd", field);
  field.parameters.set("model", "finite");
  field.parameters.set("skin.law", "fung");
  write_field(folder / "finite.dffd", field);
  const RecordedParameters finite = read_field(folder / "finite.dffd").parameters;
  EXPECT_EQ(finite->model, Model::finite);
  EXPECT_EQ(finite->skin.law, SkinLaw::fung);
  EXPECT_EQ(finite.number("skin.thickness"), 1.5);
  EXPECT_EQ(finite, read_field_parameters(folder / "finite.dffd"));
  const RecordedParameters older = read_field_parameters(folder / "older.dffd");
  EXPECT_TRUE(older.texts().empty());
  EXPECT_EQ(older->model, Model::small);
}

TEST(FieldFile, WhatIsNotCoefficientsTakesFewBytes) {
  const TemporaryFolder folder;
  const Field field = following_field();
  write_field(folder / "a.dffd", field);
  EXPECT_LE(std::filesystem::file_size(folder / "a.dffd"), record_of(field).coefficients.size() + 3000);
}

TEST(FieldFile, TheSameFieldGivesTheSameBytes) {
  const TemporaryFolder folder;
  write_field(folder / "a.dffd", following_field());
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // times are stored in seconds, if at all
  write_field(folder / "b.dffd", following_field());
  EXPECT_TRUE(read_text_file(folder / "a.dffd") == read_text_file(folder / "b.dffd"));
}

TEST(FieldFile, DamageIsNoticed) {
  for (const Field& sound : {random_field(), following_field()}) {
    const TemporaryFolder folder;
    const NodeResidual residual = random_residual();
    const CodedResidual code = coded(residual);
    write_field(folder / "a.dffd", sound, &code);
    std::optional<Field> found;
    std::optional<NodeResidual> left;
    EXPECT_EQ(unnoticed_damages(
                  folder / "a.dffd", 300,
                  [&](const std::string& file) { found = read_field(file), left = read_residual(file); },
                  [&] { return same(*found, sound) && left && left->values == residual.values; }),
              0);
  }
}

TEST(FieldFile, WhatTheFormatDoesNotAllowIsNamed) {
  // The file of a field, its header changed, written again.
  const auto refuse = [](const Field& field, const std::function<void(Json&)>& change,
                         const std::string& part) {
    FieldRecord record = record_of(field);
    change(record.header);
    try {
      field_of({header_from(header_bytes(record.header)), record.coefficients});
      ADD_FAILURE() << "accepted: " << part;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  };
  const auto nothing = [](Json&) {};
  for (const Field& field : {random_field(), following_field()}) {
    for (const char* name :
         {"case", "parametrization", "quantum", "bases", "domain", "cut", "tip", "parameters", "report"})
      refuse(
          field, [&](Json& h) { h.erase(name); }, name);
    for (const char* name : {"parametrization", "quantum", "bases", "domain", "cut", "tip", "report"})
      refuse(
          field, [&](Json& h) { h[name] = "other"; }, "");
    refuse(
        field, [](Json& h) { h["quantum"] = -1; }, "quantum");
    refuse(
        field, [](Json& h) { h["quantum"] = nullptr; }, "quantum");
    refuse(
        field, [](Json& h) { h["bases"]["along"]["knots"][0] = 1e9; }, "along");
    refuse(
        field, [](Json& h) { h["bases"]["time"]["degree"] = 99; }, "time");
    refuse(
        field,
        [](Json& h) {
          h["domain"]["w"] = {0, 0};
        },
        "domain in w");
    refuse(
        field, [](Json& h) { h["tip"]["positions"].push_back(-1000); }, "tip");
    refuse(
        field,
        [](Json& h) {
          h["tip"]["times"] = {0, 0}, h["tip"]["positions"] = {0, 1};
        },
        "tip");
    refuse(
        field, [](Json& h) { h["cut"]["depth"] = nullptr; }, "depth");
  }
  const Field field = random_field();
  std::vector<Vec3> coefficients = field.coefficients();
  coefficients[5].y = std::nan("");
  refuse(Field(field.basis(0), field.basis(1), field.basis(2), field.basis(3), coefficients, field.cut()),
         nothing, "not a finite number");
  const BSplineBasis unbroken = BSplineBasis::uniform(3, field.basis(1).size(), -20, 20);
  refuse(Field(field.basis(0), unbroken, field.basis(2), field.basis(3), field.coefficients(), field.cut()),
         nothing, "full multiplicity");
  refuse(
      following_field(), [](Json& h) { h["slices"] = 5; }, "slices");
}

TEST(FieldFile, OtherVersionsAreNamed) {
  const TemporaryFolder folder;
  for (const int version : {1, 2, 4}) {
    h5::File file = h5::File::create(folder / "a.dffd");
    file.write_text("/", "format", "cleft-field");
    file.write_number("/", "version", version);
    file.close();
    try {
      read_field(folder / "a.dffd");
      ADD_FAILURE() << "accepted";
    } catch (const FileError& e) {
      EXPECT_NE(std::string(e.what()).find("version " + std::to_string(version)), std::string::npos)
          << e.what();
    }
  }
}

TEST(FieldFile, AFieldThatIsNotWhatItsUnknownsGiveIsABug) {
  const Field field = following_field();
  std::vector<Vec3> points = field.coefficients();
  points[points.size() / 2].x += 0.3 * field.quantum;
  Field other(field.shared_parametrization(),
              {field.basis(0), field.basis(1), field.basis(2), field.basis(3)}, points);
  other.quantum = field.quantum;
  const TemporaryFolder folder;
  EXPECT_THROW(write_field(folder / "a.dffd", other), std::logic_error);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(FieldFile, FurtherQuantitiesComeBack) {
  for (Field field : {random_field(), following_field()}) {
    for (const int components : {1, 6}) {
      Quantity quantity{"stress " + std::to_string(components), components, {}};
      for (std::size_t n = 0; n < components * field.coefficients().size(); ++n)
        quantity.coefficients.push_back(static_cast<float>(n) / 7.f);
      field.quantities.push_back(quantity);
    }
    const TemporaryFolder folder;
    write_field(folder / "a.dffd", field);
    const Field found = read_field(folder / "a.dffd");
    EXPECT_TRUE(same(found, field));
    ASSERT_EQ(found.quantities.size(), 2u);
    for (std::size_t q = 0; q < 2; ++q) {
      EXPECT_EQ(found.quantities[q].name, field.quantities[q].name);
      EXPECT_EQ(found.quantities[q].coefficients, field.quantities[q].coefficients);
    }
  }
}

TEST(FieldFile, CodedQuantitiesAndDerivativesComeBack) {
  Field field = following_field();
  const auto bases = std::array{field.basis(0), field.basis(1), field.basis(2), field.basis(3)};
  const auto points = [&](double quantum, unsigned seed) {
    return quantised(random_coefficients(bases, seed), ties_of("tip", bases), bases, quantum, 0.5);
  };
  Quantity stress{"stress", 4, std::vector<double>(4 * field.coefficients().size()), 1.5, 0.01, 0.02, 0.125};
  const auto three = points(stress.quantum, 5), one = points(stress.quantum, 6);
  for (std::size_t n = 0; n < three.size(); ++n) {
    for (std::size_t c = 0; c < 3; ++c) stress.coefficients[4 * n + c] = three[n][static_cast<int>(c)];
    stress.coefficients[4 * n + 3] = one[n].x;
  }
  field.quantities = {stress};
  field.by_parameter = {{"tissue.young_modulus", points(0.25, 7), 0.25, 40, 0.03},
                        {"skin.prestress_v", points(0.5, 8), 0.5, 30, 0.02}};
  const TemporaryFolder folder;
  write_field(folder / "a.dffd", field);
  const Field found = read_field(folder / "a.dffd");
  EXPECT_TRUE(same(found, field));
  ASSERT_EQ(found.quantities.size(), 1u);
  EXPECT_EQ(found.quantities[0].coefficients, stress.coefficients);
  EXPECT_EQ(found.quantities[0].error, 0.01);
  EXPECT_EQ(found.quantities[0].spline_error, 0.02);
  ASSERT_EQ(found.by_parameter.size(), 2u);
  for (std::size_t d = 0; d < 2; ++d) {
    EXPECT_EQ(found.by_parameter[d].parameter, field.by_parameter[d].parameter);
    EXPECT_EQ(found.by_parameter[d].control_points, field.by_parameter[d].control_points);
    EXPECT_EQ(found.by_parameter[d].largest, field.by_parameter[d].largest);
    EXPECT_EQ(found.by_parameter[d].error, field.by_parameter[d].error);
  }
  std::string kept;
  EXPECT_EQ(unnoticed_damages(
                folder / "a.dffd", 60,
                [&](const std::string& file) {
                  const Field read = read_field(file);
                  kept = record_of(read).header.dump();
                },
                [&] { return kept == record_of(field).header.dump(); }),
            0);
}

TEST(FieldFile, TheResidualComesBack) {
  const TemporaryFolder folder;
  const NodeResidual residual = random_residual();
  for (const int block : {CodedResidual::most_nodes, 50, 17}) {
    const CodedResidual code = coded(residual, block);
    write_field(folder / "a.dffd", following_field(), &code);
    const auto found = read_residual(folder / "a.dffd");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->values, residual.values);
    EXPECT_EQ(found->quantum, residual.quantum);
    EXPECT_TRUE(same(read_field(folder / "a.dffd"), following_field()));
    EXPECT_EQ(h5::File::open(folder / "a.dffd").read_number("/", "version"),
              block == 17 ? field_version_of_blocks : field_version);
  }
}

TEST(FieldFile, DamagedBlocksOfAResidualAreNoticed) {
  const TemporaryFolder folder;
  const NodeResidual residual = random_residual();
  const CodedResidual code = coded(residual, 17);
  write_field(folder / "a.dffd", following_field(), &code);
  std::optional<NodeResidual> left;
  EXPECT_EQ(unnoticed_damages(
                folder / "a.dffd", 300, [&](const std::string& file) { left = read_residual(file); },
                [&] { return left && left->values == residual.values; }),
            0);
  const auto refused = [&](const std::vector<std::uint64_t>& sizes) {
    CodedResidual other = code;
    std::vector<std::uint8_t> all;
    for (const auto& block : code.blocks) all.insert(all.end(), block.begin(), block.end());
    other.blocks.clear();
    std::size_t at = 0;
    for (const std::uint64_t size : sizes) {
      const std::size_t end = std::min<std::size_t>(at + size, all.size());
      other.blocks.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(at),
                                all.begin() + static_cast<std::ptrdiff_t>(end));
      at = end;
    }
    write_field(folder / "b.dffd", following_field(), &other);
    EXPECT_THROW(read_residual(folder / "b.dffd"), FileError);
  };
  const std::uint64_t first = code.blocks[0].size(), second = code.blocks[1].size();
  refused({first, second});
  refused({first + 3, second - 3, code.blocks[2].size()});
}

TEST(FieldFile, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_field(folder / "absent.dffd"), FileError);
  EXPECT_THROW(read_field(folder.write("text.dffd", "hello")), FileError);
  EXPECT_THROW(read_field(folder.path()), FileError);
}

}  // namespace cleft
