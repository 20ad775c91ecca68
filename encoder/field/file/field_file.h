// The field file case.dffd (docs/formats.md): read and write.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "encoder/field/encoded.h"

namespace cleft {

/// Writes the field, completely or not at all: coefficients as multiples of its quantum, or as 32-bit floats
/// if it has none; and the residuals of the displacement and of the quantities, if any.
void write_field(const std::string& path, const Field& field, const CodedResidual* residual = nullptr,
                 std::span<const std::optional<CodedResidual>> of_quantities = {});
void write_field(const std::string& path, const Encoded& encoded);

/// Reads and checks a field file; throws FileError naming what is missing, damaged or out of range, or
/// InputError if it has several pieces.
Field read_field(const std::string& path);

/// The field of a piece of a body with several breaks, and what the file keeps of it at its nodes.
struct FieldPiece {
  Field field;
  std::optional<NodeResidual> residual = {};
  std::vector<std::optional<NodeResidual>> of_quantities = {};
};
/// The number of pieces of a field of several; 0 of any other. Throws FileError if it is no field.
std::size_t pieces_in(const std::string& path);
/// Writes a field of several pieces. `nodes`: of the whole body.
void write_pieces(const std::string& path, const std::vector<Encoded>& pieces, std::size_t nodes);
/// What was written: of a field with one break, one. Throws FileError as read_field() does.
std::vector<Encoded> read_encoded(const std::string& path);
/// All pieces. Throws FileError as read_field() does.
std::vector<FieldPiece> read_pieces(const std::string& path);
/// The nodes of the whole body of a field of several pieces.
std::size_t nodes_in(const std::string& path);

/// Whether it has a format of an earlier version of this program that this version does not read. Throws
/// FileError if it is not an HDF5 file.
bool is_older_field(const std::string& path);

/// Only the case's parameters: coefficients stay on disk.
RecordedParameters read_field_parameters(const std::string& path);
/// Only the report of the fit, likewise.
FitReport read_field_report(const std::string& path);

/// The residual of the field at the nodes of its snapshot; none if the file holds none.
std::optional<NodeResidual> read_residual(const std::string& path);
/// The same for the field's quantities[index].
std::optional<NodeResidual> read_quantity_residual(const std::string& path, std::size_t index);

}  // namespace cleft
