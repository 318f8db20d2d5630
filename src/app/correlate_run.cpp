#include "app/correlate_run.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "app/correlate_outputs.h"
#include "app/correlate_record.h"
#include "app/correlate_scene.h"
#include "base/files.h"
#include "base/json_file.h"
#include "base/numbers.h"
#include "correlation/field_file.h"
#include "correlation/field_tracker.h"
#include "correlation/pattern_file.h"
#include "viz/png_bytes.h"

namespace telestrain {
namespace {

namespace fs = std::filesystem;

Status WritePicture(const fs::path& path, const viz::ImageBackdrop& backdrop,
                    const viz::FieldScene& scene) {
  TELESTRAIN_ASSIGN_OR_RETURN(const viz::Picture picture, viz::DrawField(backdrop, scene));
  TELESTRAIN_ASSIGN_OR_RETURN(const std::string png, viz::PngBytes(picture.image));
  return WriteFileAtomically(path, png);
}

std::string UpdatesText(int reference_updates) {
  if (reference_updates == 0) return "";
  return ", reference replaced " + CountText(static_cast<std::size_t>(reference_updates), "time") +
         " until here";
}

// One run with what it has read and found so far.
class CorrelateRun {
 public:
  CorrelateRun(const CorrelateArguments& arguments, Console& console)
      : arguments_(arguments), console_(console) {
    if (arguments_.assess_only) arguments_.images.clear();
  }

  Status Run() {
    TELESTRAIN_RETURN_IF_ERROR(arguments_.Check());
    TELESTRAIN_ASSIGN_OR_RETURN(reference_, ReadInput(arguments_.reference));
    TELESTRAIN_RETURN_IF_ERROR(CheckImages(arguments_.images, reference_.image));
    TELESTRAIN_ASSIGN_OR_RETURN(setup_, SetUp(arguments_, reference_.image));
    TELESTRAIN_RETURN_IF_ERROR(PrepareFolder());
    TELESTRAIN_RETURN_IF_ERROR(SavePattern());
    if (!arguments_.images.empty()) TELESTRAIN_RETURN_IF_ERROR(Track());
    TELESTRAIN_RETURN_IF_ERROR(
        WriteJson(folder_ / kRecordFile, CorrelateJson(setup_, reference_, records_)));
    TELESTRAIN_RETURN_IF_ERROR(CheckRecords());
    return {};
  }

 private:
  static constexpr const char* kRecordFile = "correlate.json";

  Status PrepareFolder() {
    folder_ = arguments_.out;
    stems_ = OutputStems(arguments_.images);
    std::vector<fs::path> inputs(arguments_.images.begin(), arguments_.images.end());
    inputs.push_back(reference_.path);
    if (setup_.mask) inputs.push_back(setup_.mask->path);
    TELESTRAIN_RETURN_IF_ERROR(CheckOutputs(folder_, stems_, inputs));
    TELESTRAIN_RETURN_IF_ERROR(EnsureFolder(folder_));
    std::error_code ignored;  // older ones would describe other files than those around them
    for (const char* name : {kRecordFile, "pattern.txt", "pattern.json", "pattern.png"})
      fs::remove(folder_ / name, ignored);
    backdrop_.emplace(reference_.image, viz::kFieldImageWidth_px, viz::kFieldImageHeight_px);
    return {};
  }

  Status SavePattern() const {
    if (!setup_.pattern) {
      console_.Warn("the image is too small for an assessment of its pattern");
      return {};
    }
    std::string text;
    for (const std::string& line : PatternLines(
             *setup_.pattern, setup_.options.correlation.subset_px, setup_.options.step_px)) {
      console_.Say("pattern    " + line);
      text += line + "\n";
    }
    viz::FieldScene scene = SceneOfPattern(setup_, reference_.image);
    scene.title = ShownName(reference_.path) + ": pattern assessment";
    TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(folder_ / "pattern.txt", text));
    TELESTRAIN_RETURN_IF_ERROR(
        WriteJson(folder_ / "pattern.json", PatternFileJson(setup_, reference_)));
    return WritePicture(folder_ / "pattern.png", *backdrop_, scene);
  }

  Status Track() {
    TELESTRAIN_ASSIGN_OR_RETURN(FieldTracker tracker,
                                FieldTracker::Start(std::move(reference_.image), setup_.options));
    const int count = static_cast<int>(arguments_.images.size());
    for (int i = 0; i < count; ++i) {
      console_.Progress("correlate", i, count);
      TELESTRAIN_ASSIGN_OR_RETURN(const InputImage input, ReadInput(arguments_.images[i]));
      CorrelationField field = tracker.Track(input.image);
      if (setup_.options.mask) field = PointsInside(std::move(field), *setup_.options.mask);
      records_.push_back({ShownName(input.path), input.sha256, ShownName(stems_[i]),
                          Summarize(field), field.reference_updates});
      TELESTRAIN_RETURN_IF_ERROR(SaveField(field, stems_[i]));
      console_.Say("correlate  " + records_.back().name + ": " +
                   SummaryLine(records_.back().summary) + UpdatesText(field.reference_updates));
    }
    console_.Progress("correlate", count, count);
    return {};
  }

  Status SaveField(const CorrelationField& field, const std::string& stem) const {
    const ImageRecord& record = records_.back();
    TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(folder_ / (stem + ".csv"), FieldCsv(field)));
    TELESTRAIN_RETURN_IF_ERROR(WriteFileAtomically(
        folder_ / (stem + ".vtp"), FieldVtp(field, FieldDefinitions(setup_.options))));
    viz::FieldScene scene = SceneOfField(field, record.summary, setup_.options, arguments_.show);
    scene.title = record.name + " against " + ShownName(reference_.path);
    return WritePicture(folder_ / (stem + ".png"), *backdrop_, scene);
  }

  Status CheckRecords() const {
    for (const ImageRecord& record : records_)
      if (record.summary.converged() == 0)
        return EstimationFailed(record.name +
                                ": no point could be matched with the reference; is it the same "
                                "surface, in focus, moved by less than a quarter of the image?");
    return {};
  }

  CorrelateArguments arguments_;
  Console& console_;
  InputImage reference_;
  CorrelateSetup setup_;
  fs::path folder_;
  std::vector<std::string> stems_;
  std::optional<viz::ImageBackdrop> backdrop_;
  std::vector<ImageRecord> records_;
};

}  // namespace

Status RunCorrelation(const CorrelateArguments& arguments, Console& console) {
  return CorrelateRun(arguments, console).Run();
}

}  // namespace telestrain
