// Queries of the haptic thread in each tick: first contact of a segment, nearest point, and the proxy of a
// tip inside the surface. No query waits, allocates memory or calls the system.
#pragma once

#include "haptic/contact_surface.h"

namespace cleft {

struct SurfaceHit {
  int triangle = -1;    ///< -1: no contact
  double fraction = 0;  ///< of the segment, at the contact
  Vec3 position;
  Vec3 normal;  ///< of the triangle, outward, unit
  bool wall = false;
  explicit operator bool() const { return triangle >= 0; }
};

struct NearestPoint {
  int triangle = -1;    ///< -1: no point within the radius
  double distance = 0;  ///< mm, from the surface: negative inside
  Vec3 position;
  Vec3 normal;  ///< outward, unit; over edges and vertices the angle-weighted one
  bool wall = false;
  explicit operator bool() const { return triangle >= 0; }
};

/// The point p of the surface with x = p - depth * n(p), where n is interpolated from the vertices' normals
/// (Kobbelt et al. 1999): p, n and depth change continuously as x moves over edges of triangles.
struct SurfaceProxy {
  int triangle = -1;  ///< -1: there is none nearby
  double depth = 0;   ///< mm, along the normal; positive inside
  Vec3 position, normal;
  bool wall = false;
  explicit operator bool() const { return triangle >= 0; }
};

enum class Facing { front, back, any };  ///< into the surface, out of it

class ContactReader {
 public:
  /// Throws InputError if the surface has no free reader.
  explicit ContactReader(const ContactSurface& surface);
  ~ContactReader();
  ContactReader(const ContactReader&) = delete;
  ContactReader& operator=(const ContactReader&) = delete;

  /// Between begin() and end() all queries refer to one step of the surface. Wait-free.
  void begin();
  void end() { state_->store(ContactSurface::idle, std::memory_order_release); }
  std::uint64_t version() const { return version_; }

  SurfaceHit first_contact(const Vec3& from, const Vec3& to, Facing facing) const;
  NearestPoint nearest(const Vec3& x, double radius) const;
  /// Of a place on a triangle, linear between the corners: ContactSurface::Moved.
  double firmness(int triangle, const Vec3& place) const;
  /// The proxy of x, searched near the previous proxy; a proxy on skin stays on skin.
  SurfaceProxy proxy(const Vec3& x, const SurfaceProxy& before) const;

 private:
  const StoredTriangle& stored(int triangle) const { return surface_.triangles_[triangle].at(version_); }
  template <class May, class Look>
  void each_of(const CellList& list, const May& may, const Look& look) const;
  bool corners_of(int triangle, Corners& corners, ContactTriangle& t) const;
  void meet(const CellList& list, const Vec3& from, const Vec3& to, Facing facing, SurfaceHit& best) const;
  void walk(const Vec3& from, const Vec3& to, Facing facing, SurfaceHit& best) const;
  bool through_each_other(const Vec3& x, const Vec3& on_wall) const;
  bool project(int triangle, const Vec3& x, const SurfaceProxy& before, SurfaceProxy& out) const;
  template <class Visit>
  void visit_voxels(const Vec3& x, double radius, const Visit& visit) const;

  const ContactSurface& surface_;
  const ContactCells& cells_;
  std::atomic<std::uint64_t>* state_ = nullptr;
  std::uint64_t version_ = 0;
};

/// Calls begin() and end() for the queries of one tick.
class ContactLook {
 public:
  explicit ContactLook(ContactReader& reader) : reader_(reader) { reader_.begin(); }
  ~ContactLook() { reader_.end(); }
  ContactLook(const ContactLook&) = delete;
  ContactLook& operator=(const ContactLook&) = delete;

 private:
  ContactReader& reader_;
};

}  // namespace cleft
