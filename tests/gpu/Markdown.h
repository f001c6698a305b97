// report.json as a page for people.
#pragma once

#include "Who.h"

#include <string>

namespace gpu {

std::string markdownOf(const Json& report, bool hasSheet);

// Its sections on run time, empty where nothing was measured.
std::string goalsOf(const Json& results);
std::string profilesOf(const Json& results);
std::string equalErrorOf(const Json& bench);
std::string passesOf(const Json& results);
std::string callsOf(const Json& results);
std::string scalingOf(const Json& bench);

// Numbers for people: three digits, "-" for what is null or missing.
std::string number(const Json& value);
std::string percent(const Json& value);

} // namespace gpu
