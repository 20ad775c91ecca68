// Writes a field, reads it back and evaluates it; a missing snapshot is an error, not a crash.
#include <base/error.h>
#include <encoder/field/file/field_file.h>
#include <encoder/field/file/study_file.h>
#include <solver/snapshot/snapshot.h>

using namespace cleft;

int main(int, char** argv) {
  const BSplineBasis along = BSplineBasis::uniform(3, 4, 0, 1), across = BSplineBasis::broken(3, 8, -1, 0, 1);
  write_field(argv[1],
              Field(along, across, along, along, std::vector<Vec3>(4 * 8 * 4 * 4, {1, 2, 3}), {0, 1, 1}));
  if (norm(read_field(argv[1]).displacement({0.5, 0.5, 0.5}, Side::both, 0.5) - Vec3{1, 2, 3}) > 1e-12)
    return 1;
  try {
    SnapshotReader("absent.h5");
    return 1;
  } catch (const InputError&) {
    return 0;
  }
}
