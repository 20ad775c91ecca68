#include "tests/pipeline/cut_file.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>

namespace cleft {

CutFile read_cut(const std::string& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* mesh = reader->GetOutput();
  vtkDataArray* displacement = mesh->GetPointData()->GetArray("displacement");
  vtkDataArray* depth = mesh->GetPointData()->GetArray("depth");
  CutFile cut;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i) {
    double p[3], d[3];
    mesh->GetPoint(i, p);
    displacement->GetTuple(i, d);
    cut.displacement.push_back({d[0], d[1], d[2]});
    cut.rest.push_back(Vec3{p[0], p[1], p[2]} - cut.displacement.back());
    cut.depth.push_back(depth->GetTuple1(i));
  }
  cut.side.resize(cut.rest.size());
  for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c) {
    vtkIdType count;
    const vtkIdType* corner;
    mesh->GetCellPoints(c, count, corner);
    double deepest = 0, sum = 0;
    for (vtkIdType i = 0; i < count; ++i)
      deepest = std::max(deepest, cut.depth[corner[i]]), sum += cut.rest[corner[i]].y;
    for (vtkIdType i = 0; i < count && deepest == 0; ++i) cut.side[corner[i]] += sum;
  }
  return cut;
}

}  // namespace cleft
