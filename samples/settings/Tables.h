// Every setting, a row each, in a table for each struct: the one place that knows names, types, ranges, defaults and
// help. Command lines, state files, the viewer, and the texts that it copies are made of it; a test compares it with
// tyndall.h.
#pragma once

#include "Row.h"
#include "State.h"

namespace settings {

extern const std::vector<Choice> kProfiles; ///< of tyndall::Profile, whose values fill in Settings

const Table<tyndall::Settings>& settingsTable();
const Table<tyndall::Reuse>& reuseTable();
const Table<tyndall::Tuning>& tuningTable();
const Table<tyndall::Medium>& mediumTable(); ///< all but constituents and layers
const Table<tyndall::Constituent>& constituentTable();
const Table<tyndall::HeightLayer>& layerTable();
const Table<tyndall::Ambient>& ambientTable();
const Table<StateFog>& fogTable(); ///< all but banks
const Table<host::FogBank>& fogBankTable();
const Table<StateLight>& lightTable(); ///< all of a tyndall::Light that is a person's to set, and what StateLight adds
const Table<LookAt>& lookAtTable();
const Table<State>& pictureTable();
const Table<State>& mapsTable();
const Table<State>& volumesTable(); ///< smoke and strands
const Table<PathPoint>& pathTable();

/// As command lines have them.
std::string nameOf(tyndall::Profile profile);
std::string nameOf(tyndall::Technique technique);

/// Calls visit(name, part, table) for each part of a state that a table tells all of.
template <typename AnyState, typename Visit>
void visitTables(AnyState& state, const Visit& visit) {
  visit("picture", state, pictureTable());
  visit("maps", state, mapsTable());
  visit("volumes", state, volumesTable());
  visit("settings", state.settings, settingsTable());
  visit("reuse", state.reuse, reuseTable());
  visit("tuning", state.tuning, tuningTable());
}

/// A field of tyndall.h that no person sets.
struct Left {
  std::string field; ///< "Struct.field"
  std::string why;
};
const std::vector<Left>& leftToEngines();

} // namespace settings
