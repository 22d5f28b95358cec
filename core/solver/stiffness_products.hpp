// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of products with dt^2 K + 2 dt C (core/solver/stiffness_operator.hpp), one for each kind of
// force that is assembled. factors: those of K and C. y: displacements (mm), f: forces (N), both
// per ply and node; of a resting ply both are empty.
#pragma once

#include "contact/forces/contact_tangent.hpp"
#include "core/solver/layup.hpp"

#include <memory>
#include <vector>

namespace plyform {

using PerPly = std::vector<std::vector<Vec3>>;

struct BoundaryForces;
struct ElementForces;
struct NoForce;
struct PlyContacts;
struct ToolContacts;

/// Of a kind that is only bounded, or has none.
struct NoProduct {
  NoProduct() = default;
  NoProduct(const NoForce&, const Layup&, const TangentFactors&) {}
  /// Adds the product on one ply, which others do not feel.
  void add_on_ply(std::size_t, const PerPly&, PerPly&) const {}
  /// Tasks beside those of plies, into arrays of its own.
  int tasks() const { return 0; }
  void run(int, const PerPly&) {}
  /// After all plies and tasks, by one thread.
  void add_between(const PerPly&, PerPly&) const {}
  /// At the end adds what its tasks gave on one ply.
  void gather(std::size_t, PerPly&) const {}
};

/// Yarns, taut.
class ElementProduct : public NoProduct {
public:
  ElementProduct(const ElementForces&, const Layup& layup, const TangentFactors& factors);
  void add_on_ply(std::size_t ply, const PerPly& y, PerPly& f) const;

private:
  std::vector<std::unique_ptr<YarnStiffness>> yarns_;
};

/// Springs and the drives of grippers.
class BoundaryProduct : public NoProduct {
public:
  BoundaryProduct(const BoundaryForces& boundaries, const Layup& layup,
                  const TangentFactors& factors)
      : boundaries_(boundaries), layup_(layup), stiffness_(factors.stiffness) {}
  void add_between(const PerPly& y, PerPly& f) const;

private:
  const BoundaryForces& boundaries_;
  const Layup& layup_;
  double stiffness_;
};

/// Contacts of tools, sticking.
class ToolProduct : public NoProduct {
public:
  ToolProduct(const ToolContacts& contacts, const Layup& layup, const TangentFactors& factors);
  void add_on_ply(std::size_t ply, const PerPly& y, PerPly& f) const;

private:
  std::vector<std::vector<ContactTangent>> on_ply_;
};

/// Contacts of plies, sticking: both passes of node-to-face contact, and edge-edge contact.
class PlyProduct : public NoProduct {
public:
  PlyProduct(const PlyContacts& contacts, const Layup& layup, const TangentFactors& factors);
  int tasks() const { return static_cast<int>(pairs_.size()); }
  void run(int task, const PerPly& y);
  void gather(std::size_t ply, PerPly& f) const;

private:
  struct Pair {
    std::size_t a, b;
    std::vector<ContactTangent> up, down; ///< own nodes are of a; of b
    std::vector<Vec3> force_a, force_b;
  };
  std::vector<Pair> pairs_;
};

} // namespace plyform
