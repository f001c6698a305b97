// The window's panels, each a tab.
#pragma once

#include "FileDialog.h"
#include "Thumbnails.h"

#include <viewer/core/Viewer.h>

namespace viewer {

/// What of a light is dragged in the picture: its place, or a sun's direction; where a spot shines to; the outer angle
/// of its cone; how far it reaches.
struct Grip {
  enum class What { Place, Target, Cone, Range } what = What::Place;
  int light = 0;
};

/// What the panels share with the window.
struct Session {
  explicit Session(Viewer& what) : viewer(what) {}

  Viewer& viewer;
  FileDialog dialog;
  enum class Asked { Scene, LoadState, SaveState, SavePicture } asked = Asked::Scene; ///< of the dialog
  Thumbnails thumbnails;
  int light = 0; ///< that is edited, and drawn with all its handles
  std::optional<Grip> dragged;
  double flySpeed = 1;  ///< diagonals of the scene in ten seconds
  bool hasHelp = false; ///< whether help is shown
  bool hasMagnifier = false;
  bool hasHandles = true; ///< of lights, in the picture
  bool blinks = false;
  bool isEachLight = false; ///< whether passes of lights are listed apart
  Message message;          ///< the last one
  std::optional<std::filesystem::path> pictureToSave;
  Viewer::PixelValues magnified;
};

void drawScenePanel(Session& session);
void drawLightPanel(Session& session);
void drawMediumPanel(Session& session);
void drawSettingsPanel(Session& session);
void drawCostPanel(Session& session);
void drawComparePanel(Session& session);
void drawSavePanel(Session& session);
void drawHelp(Session& session);

/// The lights of the state, or the scene's if it has none of its own.
std::vector<settings::StateLight> editableLights(const Viewer& viewer);

} // namespace viewer
