// What a file records of a case: rows, values that no row takes, and what it lacks.
#include "params/parameters/recorded.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cleft {

TEST(RecordedParameters, WhatAFileLacksIsNoNumber) {
  RecordedParameters p;
  EXPECT_TRUE(p.empty());
  for (const Parameter& row : parameter_table()) {
    EXPECT_FALSE(p.find(row.name)) << row.name;
    if (const auto* number = std::get_if<Parameter::Number>(&row.access)) {
      Parameters values = *p;
      EXPECT_TRUE(std::isnan((*number)(values))) << row.name;
    }
  }
  p.set("skin.prestress_v", 0.03);
  EXPECT_TRUE(p.has(p->skin.prestress.vv));
  EXPECT_FALSE(p.has(p->skin.prestress.uu));
  EXPECT_EQ(p.value_or(p->skin.prestress.vv, 7.), 0.03);
  EXPECT_EQ(p.value_or(p->skin.prestress.uu, 7.), 7);
  p.erase("skin.prestress_v");
  EXPECT_EQ(p, RecordedParameters());
  EXPECT_TRUE(std::isnan(p->skin.prestress.vv));
}

/// Files that lack a choice come from a version in which it was none: pieces with free edges, whose cuts
/// ended at nodes.
TEST(RecordedParameters, AChoiceThatAFileLacksIsWhatItWasBefore) {
  const RecordedParameters p;
  EXPECT_EQ(p->skin.edges, SkinEdges::free);
  EXPECT_EQ(p->mesh.front, MeshFront::nodes);
  EXPECT_EQ(p->tissue.formulation, TissueFormulation::displacement);
  EXPECT_FALSE(p->cut.contact);
}

TEST(RecordedParameters, EveryRowComesBackByName) {
  Parameters values;
  values.cut.contact = true, values.tissue.formulation = TissueFormulation::mean_dilatation;
  values.skin.prestress = {0.1, 0.2, 0.05};
  const RecordedParameters p(values);
  RecordedParameters again;
  for (const auto& [name, value] : p.all()) {
    EXPECT_EQ(value, get_parameter(values, find_parameter(name, "here"))) << name;
    again.set(name, value);
  }
  EXPECT_EQ(p.all().size(), parameter_table().size());
  EXPECT_EQ(again, p);
  EXPECT_TRUE(again->cut.contact);
  EXPECT_EQ(again->tissue.formulation, TissueFormulation::mean_dilatation);
  EXPECT_EQ(again->skin.prestress.uv, 0.05);
  EXPECT_EQ(p.numbers().size() + p.texts().size(), p.all().size());
  EXPECT_EQ(p.texts().at("cut.contact"), "true");
  EXPECT_EQ(p.number("skin.prestress_u"), 0.1);
  EXPECT_FALSE(p.number("cut.contact"));
}

TEST(RecordedParameters, WhatNoRowTakesIsKeptAsItIs) {
  const std::map<std::string, Value> odd = {{"cut.contact", "maybe"},
                                            {"cut.frames", 2.},
                                            {"skin.thickness", "thin"},
                                            {"speed", 3.},
                                            {"made by", "somebody"}};
  RecordedParameters p;
  for (const auto& [name, value] : odd) p.set(name, value);
  EXPECT_EQ(p.all(), odd);
  EXPECT_FALSE(p.has(p->cut.contact) || p.has(p->cut.frames) || p.has(p->skin.thickness));
  EXPECT_FALSE(p->cut.contact);
  EXPECT_EQ(p.number("speed"), 3);
  p.set("cut.contact", "true");  // instead of the text before
  EXPECT_TRUE(p->cut.contact);
  EXPECT_EQ(p.all().size(), odd.size());
}

TEST(RecordedParameters, AMemberIsSetInPlace) {
  RecordedParameters p;
  p.set(p->cut.length, 12);
  EXPECT_EQ(p.numbers(), (std::map<std::string, double>{{"cut.length", 12}}));
  EXPECT_EQ(p.name_of(p->cut.length), "cut.length");
}

}  // namespace cleft
