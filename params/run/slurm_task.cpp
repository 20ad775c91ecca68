#include "params/run/slurm_task.h"

#include <csignal>
#include <cstdlib>
#include <set>

#include "base/error.h"
#include "base/process.h"
#include "base/sealed_json.h"
#include "base/text.h"
#include "params/run/slurm.h"

namespace cleft {

namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

SlurmTasks read_slurm_tasks(const std::string& file) {
  SlurmTasks tasks;
  const nlohmann::ordered_json list = read_sealed(file);
  if (!list.contains("tasks")) throw FileError(file, "holds no tasks");
  for (const nlohmann::ordered_json& task : list["tasks"])
    tasks.push_back(task.get<std::vector<std::string>>());
  return tasks;
}

RunReport run_slurm_task(const StudyFolder& folder, const Study& study, const std::vector<Case>& cases,
                         const LocalOptions& options, const std::string& tasks_file) {
  const std::string number = environment("SLURM_ARRAY_TASK_ID");
  const SlurmTasks tasks = read_slurm_tasks(tasks_file);
  const auto index =
      static_cast<std::size_t>(parse_number(number.empty() ? "0" : number, "SLURM_ARRAY_TASK_ID"));
  if (index >= tasks.size()) throw InputError(tasks_file + ": has no task " + number);
  const std::set<std::string> own(tasks[index].begin(), tasks[index].end());
  std::vector<Case> mine;  // a study that has been edited since may lack some
  for (const Case& one : cases)
    if (own.contains(one.hash())) mine.push_back(one);
  LocalOptions task_options = options;
  task_options.jobs = 1;
  if (options.ranks > 1)
    task_options.mpi_launcher = {"srun", "--mpi=pmix", "--kill-on-bad-exit=1", "-n",
                                 std::to_string(options.ranks)};
  const RunReport report = run_local(folder, study, mine, task_options);
  if (report.stopped_by != SIGUSR1) return report;
  if (report.published == 0)
    for (const Case& one : mine)
      if (CaseStatus state; const auto attempt = folder.begin(one.hash(), StudyFolder::Retry::never, state)) {
        folder.fail(*attempt,
                    "did not end within the job's time limit; raise it (slurm.time, --time), or make the "
                    "case smaller");
        break;
      }
  const std::string job = environment("SLURM_ARRAY_JOB_ID") + "_" + number;
  run_process({"scontrol", "requeue", job}, tasks_file + "." + number + ".requeue.log", {});
  return report;
}

}  // namespace cleft
