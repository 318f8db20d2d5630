// Time to append and to verify the entries of an audit trail.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>

#include "base/files.h"
#include "report/audit/audit_trail.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

Json BodyOf(int index) {
  return {{"options", {{"outliers", "median"}, {"board_warp", false}}},
          {"inputs",
           {{{"path", "session:calibration/pose_" + std::to_string(index) + ".png"},
             {"bytes", 1200000 + index},
             {"sha256", std::string(64, 'a')}}}},
          {"outputs",
           {{{"path", "calibration.json"}, {"bytes", 90000}, {"sha256", std::string(64, 'b')}}}}};
}

// With a key, every line is signed and its signature checked.
void AppendAndVerify(benchmark::State& state) {
  const fs::path folder =
      fs::temp_directory_path() / ("telestrain_audit_bench_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const fs::path key = folder / "key.pem", open_key = folder / "open.pem";
  const std::string make = "openssl genpkey -algorithm ed25519 -out " + key.string() +
                           " && openssl pkey -in " + key.string() + " -pubout -out " +
                           open_key.string();
  const bool is_signed = state.range(0) != 0;
  if (is_signed && std::system(make.c_str()) != 0) state.SkipWithError("openssl is not installed");
  for (auto _ : state) {
    fs::remove(folder / "audit.jsonl");
    auto trail = AuditTrail::Open(folder / "audit.jsonl", is_signed ? key : fs::path()).value();
    for (int i = 0; i < 10000; ++i)
      if (!trail.Append("calibrate", BodyOf(i), "2026-01-01")) state.SkipWithError("not appended");
    if (!trail.Sync()) state.SkipWithError("not written");
    const auto read =
        ReadAuditTrail("audit.jsonl", ReadFile(folder / "audit.jsonl", kMostResultBytes).value(),
                       is_signed ? ReadFile(open_key, kMostResultBytes).value() : std::string());
    if (!read || read->size() != 10000) state.SkipWithError("not verified");
  }
  fs::remove_all(folder);
}
BENCHMARK(AppendAndVerify)->ArgName("signed")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace telestrain
