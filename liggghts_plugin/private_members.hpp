#pragma once

namespace granulaw::plugin {

/// Hands out a pointer to a private member of a class of LIGGGHTS that has no call for it. An explicit
/// instantiation may name private members ([temp.spec]):
///
///   struct Tag { friend auto exposed(Tag); };
///   template struct Expose<Tag, &Class::member>;
///   object->*exposed(Tag{})
///
/// Tag and instantiation stand in this namespace itself.
template <class Tag, auto member>
struct Expose
{
  friend auto exposed(Tag) { return member; }
};

}  // namespace granulaw::plugin
