// The tasks of a Slurm array: the record of them beside their logs.
#pragma once

#include <string>
#include <vector>

namespace cleft {

using SlurmTasks = std::vector<std::vector<std::string>>;  ///< hashes of cases, by task

/// Throws FileError where the file does not hold tasks.
SlurmTasks read_slurm_tasks(const std::string& file);

}  // namespace cleft
