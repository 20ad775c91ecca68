// What killed processes left in a study's folder beside attempts.
#pragma once

#include <string>

namespace cleft {

/// Removes files that had not got their names (.study.N.part.dffd, index.json.N.part), the probes of file
/// systems (.probe.N) and the outputs of Slurm's commands whose maker, process N, has ended: none of this
/// number is on this machine, nothing in the file is locked, and it is older than some seconds (the outputs:
/// an hour), in which one of another machine would have completed or changed it.
void sweep_leftovers(const std::string& study);

/// Removes logs of packings (.pack.N.log) but `own`. Only the holder of the lock on packing makes them.
void sweep_pack_logs(const std::string& study, const std::string& own);

}  // namespace cleft
