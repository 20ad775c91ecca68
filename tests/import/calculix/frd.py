"""CalculiX's .frd to .vtu: nodes, hexahedra, and the last DISP and STRESS of the nodes."""

import pathlib

HEXAHEDRON = {1: 12}  # frd's he8: VTK's type


def numbers_of(line):
    """A line of a result: the node's number, then fields of 12 characters that may touch."""
    return [float(line[i:i + 12]) for i in range(13, len(line.rstrip("\n")) - 11, 12)]


class Frd:
    """points, and results by name: lists by the nodes' order. cells: (VTK type, indices of nodes)."""

    def __init__(self, path):
        self.points, self.cells, self.results = [], [], {}
        numbers, block, kind = {}, None, None
        for line in pathlib.Path(path).read_text().splitlines():
            key = line[:5].strip()
            if line[4:6] == "2C":
                block = "nodes"
            elif line[4:6] == "3C":
                block = "elements"
            elif key == "-4":
                block = line.split()[1]
                self.results[block] = [None] * len(self.points)
            elif key == "-3":
                block = None
            elif key == "-1" and block == "nodes":
                numbers[int(line[3:13])] = len(self.points)
                self.points.append(numbers_of(line))
            elif key == "-1" and block == "elements":
                kind = HEXAHEDRON[int(line[13:18])]
                self.cells.append((kind, []))
            elif key == "-2" and block == "elements":
                self.cells[-1][1].extend(numbers[int(n)] for n in line[3:].split())
            elif key == "-1" and block in self.results:
                self.results[block][numbers[int(line[3:13])]] = numbers_of(line)

    def vtu(self):
        def array(kind, name, components, rows):
            text = " ".join(repr(x) for row in rows for x in row)
            return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
                    f"{text}</DataArray>\n")

        corners = [nodes for _, nodes in self.cells]
        ends = [sum(map(len, corners[:i + 1])) for i in range(len(corners))]
        return ('<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>\n'
                f'<Piece NumberOfPoints="{len(self.points)}" NumberOfCells="{len(self.cells)}">\n<PointData>\n'
                + array("Float64", "U", 3, (row[:3] for row in self.results["DISP"]))
                + array("Float64", "S", 6, self.results["STRESS"])
                + "</PointData>\n<Points>\n" + array("Float64", "Points", 3, self.points)
                + "</Points>\n<Cells>\n" + array("Int64", "connectivity", 1, corners)
                + array("Int64", "offsets", 1, [[end] for end in ends])
                + array("UInt8", "types", 1, [[kind] for kind, _ in self.cells])
                + "</Cells>\n</Piece>\n</UnstructuredGrid></VTKFile>\n")
