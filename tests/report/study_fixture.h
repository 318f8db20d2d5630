#pragma once

#include <nlohmann/json.hpp>

// A study.json that uses every key and kind, and texts long enough to wrap.
nlohmann::ordered_json SampleStudy();
