#include "tests/faults/flips.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "base/error.h"
#include "base/output_file.h"
#include "base/sealed_json.h"
#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/study_file.h"
#include "params/run/study_index.h"
#include "solver/snapshot/snapshot.h"

namespace cleft::faults {

namespace fs = std::filesystem;

namespace {

template <class T>
void add(std::string& text, const std::vector<T>& values) {
  text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// All that a snapshot says, as bytes.
std::string content_of_snapshot(const std::string& file) {
  check_snapshot(file);
  const SnapshotReader reader(file);
  const Snapshot& s = reader.snapshot();
  std::string all = s.case_hash;
  add(all, s.points), add(all, s.cell_types), add(all, s.cell_offsets), add(all, s.connectivity);
  add(all, s.foundation_triangles), add(all, s.foundation_quads), add(all, s.pairs), add(all, s.released);
  add(all, s.position), add(all, s.times), add(all, s.smallest_gap);
  add(all, s.residual_equilibrium), add(all, s.residual_closure);
  for (const auto& [name, value] : s.parameters.all()) {
    all += name;
    std::visit([&](const auto& v) { all += (std::ostringstream() << v).str(); }, value);
  }
  for (std::size_t j = 0; j < s.frames(); ++j) add(all, reader.displacement(j));
  for (const SnapshotArray& array : reader.point_arrays()) {
    all += array.name;
    add(all, reader.point_array(array, 0));
  }
  return all;
}

/// A field written again is, byte for byte, what it was read from; its residual is read too.
std::string content_of_field(const std::string& file) {
  const Field field = read_field(file);
  const auto residual = read_residual(file);
  const std::string again = file + ".again.dffd";
  write_field(again, field);
  const std::string bytes = read_text_file(again);
  return bytes + (residual ? "with a residual" : "");
}

std::string content_of_study(const std::string& file) {
  const StudyFile study(file);
  std::string all;
  for (int i = 0; i < study.size(); ++i) {
    all += study.name(i) + study.case_hash(i);
    for (const auto& [name, value] : study.parameters(i).all()) all += name + to_text(value);
    write_field(file + ".again.dffd", study.field(i));
    all += read_text_file(file + ".again.dffd");
  }
  return all;
}

std::string content_of_index(const std::string& study) {
  std::string all;
  for (const auto& [hash, one] : study_index(study))
    all += hash + one.solve + shortest(one.seconds) + shortest(one.bytes) + shortest(one.nodes) +
           (one.snapshot ? "kept" : "dropped");
  return all;
}

struct Target {
  std::string file;
  std::function<std::string()> content;
};

}  // namespace

FlipReport flip_at_random(const StudyUnderFault& study, int damages, std::mt19937& random) {
  const std::string place = study.place() + "/flipped";
  fs::copy(study.reference(), place, fs::copy_options::recursive);
  study_index(place);
  const std::string one = fs::directory_iterator(place + "/cases")->path().string();
  const std::vector<Target> targets = {
      {one + "/case.h5", [&] { return content_of_snapshot(one + "/case.h5"); }},
      {one + "/case.dffd", [&] { return content_of_field(one + "/case.dffd"); }},
      {place + "/study.dffd", [&] { return content_of_study(place + "/study.dffd"); }},
      {one + "/manifest.json", [&] { return read_sealed(one + "/manifest.json").dump(); }},
      {place + "/index.json", [&] { return content_of_index(place); }}};
  std::vector<std::string> sound, content;
  for (const Target& target : targets) {
    sound.push_back(read_text_file(target.file));
    content.push_back(target.content());
  }
  FlipReport report;
  for (; report.damages < damages; ++report.damages) {
    const std::size_t t = static_cast<std::size_t>(report.damages) % targets.size();
    std::string bytes = sound[t];
    const std::size_t at = std::uniform_int_distribution<std::size_t>(0, bytes.size() - 1)(random);
    const bool cut = random() % 4 == 0;
    const unsigned bit = random() % 8;
    if (cut)
      bytes.resize(at);
    else
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
    std::ofstream(targets[t].file, std::ios::binary) << bytes;
    try {
      promise(targets[t].content() == content[t],
              targets[t].file + (cut ? ", cut to " : ", bit " + std::to_string(bit) + " of byte ") +
                  std::to_string(at) + ": the damage goes unseen");
      ++report.without_effect;
    } catch (const InputError&) {
      ++report.detected;
    }
    std::ofstream(targets[t].file, std::ios::binary) << sound[t];
  }
  fs::remove_all(place);
  return report;
}

}  // namespace cleft::faults
