// What a test looks at: digests of OGRE's pictures, frame by frame, and the light that Tyndall adds.
#pragma once

#include <Ogre.h>
#include <fstream>
#include <map>
#include <tyndall/tyndall.h>

class Recorder {
public:
  /// Where to write digests and the last frame's inscatter; empty: not wanted.
  Recorder(const std::string& digests, std::string inscatter);

  /// Has the frame write inscatter and transmittance into textures of the recorder's; not into colour, unless wanted.
  void wantOutputs(tyndall::Frame& frame, bool colourToo);
  /// One line: the HDR colour of each viewport, the window.
  void digest(Ogre::RenderWindow& window, const std::vector<Ogre::CompositorInstance*>& compositors);
  /// The inscatter of the frame that was drawn last: width and height as a line of text, then RGBA floats, row 0 at the
  /// top.
  void writeInscatter();

private:
  struct Outputs {
    Ogre::TexturePtr inscatter, transmittance;
  };
  std::map<std::pair<int, int>, Outputs> outputs_; ///< by size
  std::pair<int, int> size_;                       ///< of the last frame
  std::ofstream digests_;
  std::string inscatter_;
};
