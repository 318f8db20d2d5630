#include <CLI/CLI.hpp>
#include <set>

#include "app/command.h"
#include "app/results_folder.h"
#include "app/step_record.h"
#include "app/steps.h"
#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "base/value_names.h"
#include "viz/picture_set.h"
#include "viz/review/results_shape.h"
#include "viz/review/review_page.h"
#include "viz/scene_from_results.h"

// telestrain review RESULTS
// Draws the standard pictures first where they are not all there.
//   review     /data/results/review.html, 9.2 MB: scene with 164 parts, 14 pictures, 37 tables

namespace telestrain {
namespace {

namespace fs = std::filesystem;

// The standard pictures in the order in which they are drawn. The contact sheet shows them once
// more and is left out.
Result<std::vector<viz::ReviewPicture>> ReadPictures(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end;
       entry.increment(code))
    if (const std::string name = entry->path().filename().string(); viz::IsStandardPicture(name))
      names.insert(name);
  std::vector<viz::ReviewPicture> pictures;
  for (const viz::PictureKind& kind : viz::PictureKinds()) {
    const std::string stem = kind.name;
    for (const std::string& name : names) {
      const bool of_state = kind.of_every_state && name.starts_with(stem + "_");
      if (kind.draw == nullptr || (name != stem + ".png" && !of_state)) continue;
      TELESTRAIN_ASSIGN_OR_RETURN(std::string png, ReadFile(folder / name, kMostImageBytes));
      pictures.push_back({name, std::move(png)});
    }
  }
  return pictures;
}

// results.json says which files it was made of.
Status RequireSameEvidence(const nlohmann::ordered_json& json, const fs::path& results) {
  for (const auto& table : json.at("tables")) {
    if (table.at("id") != "result-files") continue;
    for (const auto& row : table.at("rows")) {
      const std::string name = row.at(0).get<std::string>();
      TELESTRAIN_ASSIGN_OR_RETURN(const std::string hash, Sha256HexOfFile(results / name));
      if (row.at(row.size() - 1) != hash)
        return BadInput((results / "results.json").string() + ": was made from another " + name +
                        " than the one that lies beside it; run 'telestrain report' again");
    }
  }
  return {};
}

Result<viz::ReviewContent> ReadContent(const fs::path& results, Console& console) {
  TELESTRAIN_RETURN_IF_ERROR(RequireConsistent(results, Step::kReview));
  viz::ReviewContent content;
  content.version = TELESTRAIN_VERSION;
  content.vtk_js = viz::BuiltInVtkJs();
  TELESTRAIN_ASSIGN_OR_RETURN(
      content.results,
      ReadJson(results / "results.json", "telestrain.results/1", "telestrain report"));
  TELESTRAIN_RETURN_IF_ERROR(
      viz::RequireResultsShape(content.results, (results / "results.json").string()));
  try {
    TELESTRAIN_RETURN_IF_ERROR(RequireSameEvidence(content.results, results));
  } catch (const nlohmann::json::exception& e) {
    return BadInput((results / "results.json").string() + ": " + JsonProblem(e) +
                    "; run 'telestrain report' again");
  }
  for (const char* name : {"results.json", "calibration.json"}) {
    TELESTRAIN_ASSIGN_OR_RETURN(std::string hash, Sha256HexOfFile(results / name));
    content.hashes.emplace_back(name, std::move(hash));
  }
  TELESTRAIN_ASSIGN_OR_RETURN(const bool complete, PicturesAreComplete(results));
  if (!complete) TELESTRAIN_RETURN_IF_ERROR(RenderStep(results, RenderOptions{}, {}, console));
  TELESTRAIN_ASSIGN_OR_RETURN(content.pictures, ReadPictures(results / "pictures"));
  TELESTRAIN_ASSIGN_OR_RETURN(content.scene, viz::SceneFromResults(results));
  content.list = viz::PartsOf(content.scene);
  return content;
}

class ReviewCommand : public Command {
 public:
  std::string Name() const override { return "review"; }
  std::string Summary() const override {
    return "put verdict, scene, pictures and tables into one HTML file that opens anywhere";
  }
  std::string Example() const override { return "telestrain review results"; }
  void AddOptions(CLI::App& app) override {
    app.add_option("RESULTS", results_, "results folder of the earlier steps")
        ->type_name(kFolder)
        ->required();
    app.add_option("--out", out_, "the file to write (default: RESULTS/review.html)")
        ->type_name(kFile);
  }
  Result<int> Run(Console& console) override {
    TELESTRAIN_ASSIGN_OR_RETURN(const ResultsLock lock, ResultsLock::Take(results_));
    const fs::path path = out_.empty() ? fs::path(results_) / "review.html" : fs::path(out_);
    TELESTRAIN_ASSIGN_OR_RETURN(const viz::ReviewContent content, ReadContent(results_, console));
    TELESTRAIN_ASSIGN_OR_RETURN(const std::string page, viz::ReviewPage(content));
    TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(path, page));
    const bool interactive = !content.vtk_js.script.empty();
    if (!interactive)
      console.Warn(
          "the page has no interactive scene, because this program was built without vtk.js; "
          "install npm and run 'bash bootstrap build' with the network on");
    std::error_code code;
    console.Say("review     " + fs::absolute(path, code).lexically_normal().string() + ", " +
                FormatFixed(static_cast<double>(page.size()) / 1e6, 1) + " MB: " +
                (interactive ? "scene with " + CountText(content.list.parts.size(), "part")
                             : std::string("no scene")) +
                ", " + CountText(content.pictures.size(), "picture") + ", " +
                CountText(content.results.at("tables").size(), "table"));
    StepRecord record = SceneRecord("review", results_);
    record.inputs.push_back("results.json");
    for (const viz::ReviewPicture& picture : content.pictures)
      record.inputs.push_back("pictures/" + picture.name);
    record.options = {{"out", RecordedPlace(results_, out_)}};
    record.outputs = {path.filename().string()};
    record.outputs_folder = path.has_parent_path() ? path.parent_path() : ".";
    TELESTRAIN_RETURN_IF_ERROR(RecordStep(results_, record));
    return 0;
  }

 private:
  std::string results_, out_;
};

}  // namespace

std::unique_ptr<Command> MakeReviewCommand() { return std::make_unique<ReviewCommand>(); }

}  // namespace telestrain
