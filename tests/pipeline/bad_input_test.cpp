// Wrong input: a clear message, exit code 2, and no file left.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "tests/field/random_field.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

class BadInput : public testing::Test {
 protected:
  TemporaryFolder in, out;

  void expect_refused(const std::string& command, const std::vector<std::string>& arguments,
                      const std::vector<std::string>& parts) {
    const Outcome outcome = run_cleft(command, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    for (const std::string& part : parts)
      EXPECT_NE(outcome.output.find(part), std::string::npos)
          << "missing '" << part << "' in: " << outcome.output;
    EXPECT_EQ(out.entries(), 0) << "something was left behind";
  }

  std::string solved() {
    in.write("good.toml",
             "[case]\npatch.length = 12\npatch.width = 8\npatch.height = 4\ncut.length = 6\ncut.depth = "
             "2\nmesh.element_size = 2\n");
    expect_success(run_cleft("solve", {in / "good.toml", "--out", in / "good.h5"}));
    return in / "good.h5";
  }
  std::string field() {
    write_field(in / "field.dffd", random_field());
    return in / "field.dffd";
  }
  std::string flat_mesh() {
    return in.write("flat.obj", "v -40 -30 0\nv 40 -30 0\nv 40 30 0\nv -40 30 0\nf 1 2 3\nf 1 3 4\n");
  }
  std::string path(double z) {
    return in.write("path.csv",
                    "x,y,z,nx,ny,nz\n-10,0," + shortest(z) + ",0,0,1\n10,0," + shortest(z) + ",0,0,1\n");
  }
};

}  // namespace

TEST_F(BadInput, UnknownParameter) {
  for (const char* command : {"solve", "run"})
    expect_refused(command, {in.write("a.toml", "[case]\ntisue.young_modulus = 1\n"), "--out", out / "x"},
                   {"line 2", "'tisue.young_modulus'", "did you mean 'tissue.young_modulus'"});
}

TEST_F(BadInput, ValueOutOfRange) {
  for (const char* command : {"solve", "run"})
    expect_refused(command, {in.write("a.toml", "[case]\nskin.thickness = -1\n"), "--out", out / "x"},
                   {"line 2", "skin.thickness = -1", "greater than 0 mm"});
  expect_refused("solve",
                 {in.write("a.toml", ""), "--out", out / "x.h5", "--set", "tissue.poisson_ratio=0.7"},
                 {"tissue.poisson_ratio = 0.7", "between 0 and 0.49"});
}

TEST_F(BadInput, CutLongerThanThePatch) {
  for (const char* command : {"solve", "run"})
    expect_refused(command, {in.write("a.toml", "[case]\ncut.length = 101\n"), "--out", out / "x"},
                   {"cut.length = 101 mm", "patch.length = 100 mm"});
}

TEST_F(BadInput, MissingFiles) {
  expect_refused("solve", {in / "absent.toml", "--out", out / "x.h5"}, {"absent.toml"});
  expect_refused("run", {in / "absent.toml", "--out", out / "x"}, {"absent.toml"});
  expect_refused("encode", {in / "absent.h5", "--out", out / "x.dffd"}, {"absent.h5", "no such file"});
  expect_refused("eval", {in / "absent.dffd", "--points", in / "p.csv", "--out", out / "x.csv"},
                 {"absent.dffd"});
  expect_refused("cut",
                 {"--mesh", in / "absent.stl", "--path", path(0), "--field", field(), "--out", out / "x.vtp"},
                 {"absent.stl"});
  expect_refused(
      "cut", {"--mesh", flat_mesh(), "--path", in / "absent.csv", "--field", field(), "--out", out / "x.vtp"},
      {"absent.csv"});
  expect_refused("info", {in / "absent.h5"}, {"absent.h5"});
  expect_refused("check", {in / "absent.h5"}, {"absent.h5"});
  expect_refused("status", {in / "absent"}, {"absent"});
  expect_refused("explore", {in / "absent", "--screenshot", out / "x.png"}, {"absent"});
  expect_refused("solve", {in.write("a.toml", ""), "--out", out / "absent/x.h5"}, {"does not exist"});
}

TEST_F(BadInput, TruncatedAndFlippedFiles) {
  const std::string snapshot = read_text_file(solved()), field_bytes = read_text_file(field());
  const auto truncated = [](const std::string& bytes) { return bytes.substr(0, bytes.size() * 2 / 3); };
  // One bit of the data: of a point's coordinates in the snapshot, and amid the packed control points of the
  // field.
  const auto flipped = [](std::string bytes) {
    const double corner[] = {-6, -4, 0};
    const std::size_t found = bytes.find(std::string(reinterpret_cast<const char*>(corner), sizeof corner));
    const std::size_t at = found == std::string::npos ? bytes.size() / 2 : found + 5;
    bytes[at] = static_cast<char>(bytes[at] ^ 16);
    return bytes;
  };
  for (const bool cut_short : {true, false}) {
    const std::string s = in.write("bad.h5", cut_short ? truncated(snapshot) : flipped(snapshot));
    const std::string f = in.write("bad.dffd", cut_short ? truncated(field_bytes) : flipped(field_bytes));
    expect_refused("encode", {s, "--out", out / "x.dffd"}, {"bad.h5"});
    expect_refused("check", {s}, {"bad.h5"});
    expect_refused("check", {f}, {"bad.dffd"});
    expect_refused("eval",
                   {f, "--points", in.write("p.csv", "u,v,w,side,t\n0,1,0,0,1\n"), "--out", out / "x.csv"},
                   {"bad.dffd"});
    expect_refused("cut", {"--mesh", flat_mesh(), "--path", path(0), "--field", f, "--out", out / "x.vtp"},
                   {"bad.dffd"});
    expect_refused("explore", {f, "--screenshot", out / "x.png"}, {"bad.dffd"});
  }
  expect_refused("encode", {field(), "--out", out / "x.dffd"}, {"is not a snapshot"});
  expect_refused("eval", {solved(), "--points", in / "p.csv", "--out", out / "x.csv"}, {"is not a field"});
}

TEST_F(BadInput, MeshWithoutTriangles) {
  for (const char* name : {"empty.obj", "empty.ply", "empty.stl", "empty.vtp"})
    expect_refused(
        "cut", {"--mesh", in.write(name, ""), "--path", path(0), "--field", field(), "--out", out / "x.vtp"},
        {name});
  expect_refused("cut",
                 {"--mesh", in.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "--path", path(0),
                  "--field", field(), "--out", out / "x.vtp"},
                 {"points.obj", "triangle"});
  expect_refused("cut",
                 {"--mesh", in.write("mesh.xyz", "0 0 0\n"), "--path", path(0), "--field", field(), "--out",
                  out / "x.vtp"},
                 {"mesh.xyz", ".stl"});
}

TEST_F(BadInput, PathThatNeverTouchesTheMesh) {
  expect_refused("cut",
                 {"--mesh", flat_mesh(), "--path", path(500), "--field", field(), "--out", out / "x.vtp"},
                 {"never touches", "500"});
  expect_refused("cut",
                 {"--mesh", flat_mesh(), "--path",
                  in.write("p.csv", "x,y,z,nx,ny,nz,dept\n0,0,0,0,0,1,2\n9,0,0,0,0,1,2\n"), "--field",
                  field(), "--out", out / "x.vtp"},
                 {"unknown column 'dept'", "did you mean 'depth'"});
  expect_refused("cut",
                 {"--mesh", flat_mesh(), "--path", path(0), "--field", field(), "--out", out / "x.xyz"},
                 {"x.xyz", ".vtp"});
}

TEST_F(BadInput, TensionThatNothingIsKnownOf) {
  const std::vector<std::string> cut = {"--mesh", flat_mesh(),   "--field", field(),
                                        "--out",  out / "x.vtp", "--path"};
  const auto refused = [&](std::vector<std::string> more, const std::vector<std::string>& words) {
    more.insert(more.begin(), cut.begin(), cut.end());
    expect_refused("cut", more, words);
  };
  refused({path(0), "--tension", "1,0,0"}, {"--tension", "--prestress"});
  refused({path(0), "--tension", "1,0", "--prestress", "0.02,0.01"}, {"--tension", "3"});
  refused({path(0), "--tension", "1,0,0", "--prestress", "0.02,0.01"}, {"field.dffd", "study.dffd"});
  refused({in.write("p.csv", "x,y,z,nx,ny,nz,skin.prestress_v\n0,0,0,0,0,1,0.1\n9,0,0,0,0,1,0.2\n")},
          {"p.csv", "study.dffd"});
  expect_refused("cut",
                 {"--mesh", flat_mesh(), "--path", path(0), "--field", field(), "--out", out / "x.vtu"},
                 {"x.vtu", ".vtp"});
  expect_refused("cut",
                 {"--mesh", in.write("box.vtu", "<VTKFile"), "--path", path(0), "--field", field(), "--out",
                  out / "x.vtu"},
                 {"box.vtu"});
}

TEST_F(BadInput, AnOutputThatIsTheInput) {
  const std::string snapshot = solved(), kept = read_text_file(snapshot);
  expect_refused("encode", {snapshot, "--out", snapshot}, {"is the input"});
  EXPECT_EQ(read_text_file(snapshot), kept);
  expect_refused("solve", {in / "good.toml", "--out", in / "good.toml"}, {"is the input"});
  expect_refused("cut",
                 {"--mesh", flat_mesh(), "--path", path(0), "--field", field(), "--out", in / "flat.obj"},
                 {"is the input"});
  expect_refused(
      "eval",
      {field(), "--points", in.write("p.csv", "u,v,w,side,t\n0,1,0,0,1\n"), "--out", in / "field.dffd"},
      {"is the input"});
  expect_refused("encode", {snapshot, "--out", "/dev/null"}, {"/dev/null", "not a file"});
}

TEST_F(BadInput, NumbersThatAreNone) {
  const std::vector<std::string> cut = {"--mesh",  flat_mesh(), "--path", path(0),
                                        "--field", field(),     "--out",  out / "x.vtp"};
  for (const char* option : {"--progress", "--depth", "--scale", "--max-edge"}) {
    std::vector<std::string> arguments = cut;
    arguments.insert(arguments.end(), {option, "nan"});
    expect_refused("cut", arguments, {option, "'nan'"});
  }
}

TEST_F(BadInput, AMeshFileThatEndsEarly) {
  expect_success(run_cleft("cut", {"--mesh", flat_mesh(), "--path", path(0), "--rest", "--depth", "2",
                                   "--out", in / "whole.stl"}));
  const std::string bytes = read_text_file(in / "whole.stl");
  expect_refused("cut",
                 {"--mesh", in.write("half.stl", bytes.substr(0, bytes.size() / 2)), "--path", path(0),
                  "--field", field(), "--out", out / "x.vtp"},
                 {"half.stl", "promises"});
}

/// What is no user's mistake ends with exit code 1, and leaves nothing either.
TEST_F(BadInput, AFullDiskIsTold) {
  const std::string snapshot = solved();
  for (const std::string& command : {"solve " + (in / "good.toml") + " --out " + (out / "x.h5"),
                                     "encode " + snapshot + " --out " + (out / "x.dffd")}) {
    const Outcome outcome = on_a_full_disk(2, std::string(CLEFT_BIN) + "/cleft " + command);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
    EXPECT_NE(outcome.output.find("disk full"), std::string::npos) << outcome.output;
    EXPECT_EQ(out.entries(), 0);
  }
}

TEST_F(BadInput, AFailureOnOneOfTwoRanksEndsBoth) {
  solved();
  const Outcome floating =
      cleft_on_ranks("solve", 2,
                     {in / "good.toml", "--out", out / "x.h5", "--set", "foundation.stiffness=1e-300",
                      "--set", "foundation.side_stiffness=0"});
  EXPECT_NE(floating.exit_code, 0);
  EXPECT_NE(floating.output.find("not positive definite"), std::string::npos) << floating.output;
  EXPECT_EQ(out.entries(), 0);
  const Outcome wrong =
      cleft_on_ranks("solve", 2, {in / "good.toml", "--out", out / "x.h5", "--set", "cut.length=99"});
  EXPECT_EQ(wrong.exit_code, 2) << wrong.output;
}

TEST_F(BadInput, Usage) {
  EXPECT_EQ(run_cleft("encoode", {}).exit_code, 2);
  EXPECT_NE(run_cleft("encoode", {}).output.find("did you mean 'encode'"), std::string::npos);
  expect_refused("encode", {}, {"CASE.h5"});
  expect_refused("solve", {"a.toml", "--out", out / "x.h5", "--nonsense"}, {"--nonsense"});
  expect_refused("eval", {field(), "--points", in.write("p.csv", "u,v,w,side,t\n0,1,0,0,99\n")},
                 {"row 1", "t = 99"});
  expect_refused("eval", {field(), "--points", in.write("p.csv", "u,v,w,t\n0,1,0,9\n")}, {"'side'"});
  const std::vector<std::string> encode = {solved(), "--out", out / "x.dffd"};
  const auto expect_encode_refused = [&](const std::vector<std::string>& options, const std::string& part) {
    std::vector<std::string> arguments = encode;
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_refused("encode", arguments, {part});
  };
  expect_encode_refused({"--control-points", "9,8,7,4"}, "9 control points");
  expect_encode_refused({"--control-points", "3,8,4,4", "--parametrization", "fixed"}, "3 control points");
  expect_encode_refused({"--control-points", "1000,1000,100,4"}, "at most");
  expect_encode_refused({"--control-points", "10,8,7,4", "--tolerance", "0.01"}, "--tolerance");
  expect_encode_refused({"--regularisation", "3e-5"}, "requires --control-points");
  for (const char* wrong : {"0", "1", "nan"})
    expect_encode_refused({"--control-points", "10,8,7,4", "--regularisation", wrong},
                          std::string("--regularisation = ") + wrong + ": must be between 1e-10 and 0.1");
  for (const char* tolerance : {"0", "1", "nan", "-1"})
    expect_encode_refused({"--tolerance", tolerance}, "--tolerance");
  expect_encode_refused({"--parametrization", "tips"}, "--parametrization");
}

TEST_F(BadInput, NodesAndFramesThatAreNotTheFields) {
  const std::string snapshot = solved(), encoded = in / "encoded.dffd";
  expect_success(run_cleft("encode", {snapshot, "--out", encoded, "--tolerance", "1e-4"}));
  const auto refused = [&](const std::string& nodes, const char* frame,
                           const std::vector<std::string>& parts) {
    expect_refused("eval", {encoded, "--nodes", nodes, "--frame", frame, "--out", out / "x.csv"}, parts);
  };
  refused(snapshot, "99", {"--frame", "99", "frames 0 to"});
  refused(snapshot, "-1", {"--frame"});
  refused(encoded, "1", {"is not a snapshot"});
  expect_refused("eval", {encoded, "--nodes", snapshot, "--out", out / "x.csv"}, {"--frame"});
  expect_refused("eval", {encoded, "--frame", "1", "--out", out / "x.csv"}, {"--nodes"});
  expect_success(
      run_cleft("solve", {in / "good.toml", "--out", in / "other.h5", "--set", "mesh.element_size=1"}));
  refused(in / "other.h5", "1", {"other.h5", "case"});
}

TEST_F(BadInput, AWindowWithoutADisplayNamesTheRemedy) {
  unsetenv("DISPLAY");
  expect_refused("explore", {}, {"no display", "--screenshot", "--script"});
}

TEST_F(BadInput, ConditionsAndScriptsSayWhereTheyAreWrong) {
  expect_refused("find", {in / "absent", "--where", "gape > "},
                 {"condition 'gape > '", "a value is missing"});
  expect_refused("find", {in / "absent", "--where", "gape > 1"}, {"absent"});
  in.write("script.txt", "# nothing\ncolr gape\n");
  expect_refused("explore", {"--script", in / "script.txt"}, {"script.txt:2", "did you mean 'color'"});
}

TEST_F(BadInput, EveryCommandHelpsAndTellsItsVersion) {
  for (const char* command : {"run", "status", "solve", "encode", "eval", "cut", "explore", "find", "export",
                              "info", "check", "pack", "import"}) {
    EXPECT_NE(
        expect_success(run_cleft(command, {"--help"})).output.find("Usage: cleft " + std::string(command)),
        std::string::npos)
        << command;
    // MPI may complain on standard error about the machine first.
    EXPECT_TRUE(expect_success(run_cleft(command, {"--version"})).output.ends_with(producer() + "\n"))
        << command;
  }
}

}  // namespace cleft
