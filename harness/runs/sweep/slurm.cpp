// Writes job scripts for Slurm.
#include "harness/runs/sweep/slurm.hpp"

#include <fmt/format.h>

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

std::string absolute_word(const fs::path& path) {
  return shell_word(fs::absolute(path).lexically_normal().string());
}

}  // namespace

fs::path slurm_folder(const fs::path& sweep) {
  return sweep / "slurm";
}

std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:@%+";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return word + "'";
}

SlurmScripts slurm_scripts(const SweepPlan& plan, const SlurmOptions& options) {
  const std::string program = absolute_word(options.program);
  const std::string sweep = absolute_word(plan.folder);
  const std::string log = fs::absolute(slurm_folder(plan.folder)).lexically_normal().string();
  SlurmScripts scripts;
  // SIGTERM comes a minute before the time limit; the shard then commits what it has.
  scripts.array = fmt::format(
      "#!/bin/bash\n"
      "#SBATCH --job-name=scanbench\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --cpus-per-task={1}\n"
      "#SBATCH --output=\"{0}/%A_%a.log\"\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --requeue\n"
      "#SBATCH --signal=B:TERM@60\n"
      "exec {2} sweep run {3} --jobs {1} --quiet\n",
      log, options.jobs, program, sweep);
  scripts.merge = fmt::format(
      "#!/bin/bash\n"
      "#SBATCH --job-name=scanbench-merge\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --output=\"{0}/merge_%j.log\"\n"
      "exec {1} sweep merge {2} --out {3}\n",
      log, program, sweep, absolute_word(options.run));
  return scripts;
}

}  // namespace scanbench::runs
