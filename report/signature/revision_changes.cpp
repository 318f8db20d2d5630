#include "report/signature/revision_changes.h"

#include <initializer_list>
#include <set>

#include "report/signature/object_names.h"
#include "report/signature/opened_pdf.h"
#include "report/signature/roles.h"
#include "report/signature/signature_boxes.h"

namespace telestrain {
namespace {

using Object = QPDFObjectHandle;

bool Same(Object a, Object b) { return a.unparse() == b.unparse(); }

// Whether two dictionaries agree in all but these keys.
bool SameExcept(Object a, Object b, std::initializer_list<const char*> keys) {
  if (!a.isDictionary() || !b.isDictionary()) return false;
  Object rest_a = a.shallowCopy(), rest_b = b.shallowCopy();
  for (const char* key : keys) {
    rest_a.removeKey(key);
    rest_b.removeKey(key);
  }
  return rest_a.unparse() == rest_b.unparse();
}

bool IsNothing(Object rectangle) {
  if (!rectangle.isArray()) return false;
  for (Object side : rectangle.getArrayAsVector())
    if (!side.isNumber() || side.getNumericValue() != 0) return false;
  return true;
}

class Comparison {
 public:
  Comparison(QPDF& before, QPDF& after, const SignedUpdate& update)
      : before_(before), after_(after), update_(update) {
    for (Object object : before.getAllObjects()) old_.insert(object.getObjectID());
    for (SignatureField& field : SignatureFieldsOf(before))
      if (field.role == update.role) field_ = field.field.getObjectID();
    NoteArrays();
  }

  std::string Run() {
    for (const char* key : {"/Root", "/Info"})
      if (!Same(before_.getTrailer().getKey(key), after_.getTrailer().getKey(key)))
        return std::string("the trailer's ") + key + " was changed";
    if (!Same(before_.getTrailer().getKey("/ID").getArrayItem(0),
              after_.getTrailer().getKey("/ID").getArrayItem(0)))
      return "the trailer's /ID was changed";
    for (Object object : before_.getAllObjects()) {
      Object now = after_.getObject(object.getObjGen());
      if (ContentOf(object) != ContentOf(now) && !IsAllowed(object, now)) return Describe(object);
    }
    return "";
  }

 private:
  // The arrays that may grow, where they are objects of their own.
  void NoteArrays() {
    const auto note = [this](Object array) {
      if (array.isArray() && array.isIndirect()) growing_.insert(array.getObjectID());
    };
    for (Object page : before_.getAllPages()) {
      pages_.insert(page.getObjectID());
      note(page.getKey("/Annots"));
    }
    form_ = before_.getRoot().getKey("/AcroForm");
    if (form_.isDictionary()) note(form_.getKey("/Fields"));
  }

  std::string Describe(Object object) {
    const auto names = NamesOfObjects(before_);
    const int number = object.getObjectID();
    const auto found = names.find(number);
    const std::string id = "object " + std::to_string(number);
    return (found == names.end() ? id : found->second + " (" + id + ")") + " was changed";
  }

  bool IsAllowed(Object object, Object now) {
    const int number = object.getObjectID();
    if (number == before_.getRoot().getObjectID())
      return SameExcept(object, now, {"/AcroForm", "/Perms"}) &&
             MayBePerms(object.getKey("/Perms"), now.getKey("/Perms")) &&
             MayBeForm(object.getKey("/AcroForm"), now.getKey("/AcroForm"));
    if (form_.isIndirect() && number == form_.getObjectID()) return MayBeForm(object, now, true);
    if (number == field_)
      return SameExcept(object, now, {"/V", "/AP"}) && !object.hasKey("/V") &&
             IsSignature(now.getKey("/V")) && MayBePicture(now);
    if (pages_.count(number) > 0)
      return SameExcept(object, now, {"/Annots"}) &&
             MayGrow(object.getKey("/Annots"), now.getKey("/Annots"));
    return growing_.count(number) > 0 && HasGrown(object, now);
  }

  bool IsSignature(Object value) const {
    return value.isIndirect() && value.getObjectID() == update_.object &&
           old_.count(update_.object) == 0;
  }

  // The field's box is fixed (BoxesFailure), so the picture cannot cover anything else.
  static bool MayBePicture(Object field) {
    Object appearance = field.getKey("/AP");
    return appearance.isNull() || FillsBox(appearance, field.getKey("/Rect"));
  }

  bool MayBePerms(Object was, Object is) {
    if (Same(was, is)) return true;
    return was.isNull() && update_.role == kSealingRole && is.isDictionary() &&
           IsSignature(is.getKey("/DocMDP")) &&
           SameExcept(is, Object::newDictionary(), {"/DocMDP"});
  }

  // `is_object`: the form is an object of its own and this is it.
  bool MayBeForm(Object was, Object is, bool is_object = false) {
    if (!is_object && Same(was, is)) return true;
    if (was.isNull() && is.isIndirect() && old_.count(is.getObjectID()) > 0) return false;
    if (!is_object && !was.isNull() && (was.isIndirect() || is.isIndirect())) return false;
    if (was.isNull()) was = Object::newDictionary();
    return SameExcept(was, is, {"/Fields", "/SigFlags"}) && is.getKey("/SigFlags").isInteger() &&
           is.getKey("/SigFlags").getIntValue() == 3 &&
           MayGrow(was.getKey("/Fields"), is.getKey("/Fields"));
  }

  bool MayGrow(Object was, Object is) {
    if (Same(was, is)) return true;
    return !was.isIndirect() && !is.isIndirect() && HasGrown(was, is);
  }

  // By the new field at its end.
  bool HasGrown(Object was, Object is) {
    if (!is.isArray() || !(was.isArray() || was.isNull())) return false;
    const int old_size = was.isArray() ? was.getArrayNItems() : 0;
    if (is.getArrayNItems() != old_size + 1) return false;
    for (int i = 0; i < old_size; ++i)
      if (!Same(was.getArrayItem(i), is.getArrayItem(i))) return false;
    return IsNewField(is.getArrayItem(old_size));
  }

  // Invisible, so that it cannot cover anything.
  bool IsNewField(Object field) {
    return field_ == 0 && field.isIndirect() && old_.count(field.getObjectID()) == 0 &&
           SameExcept(field, Object::newDictionary(),
                      {"/Type", "/Subtype", "/FT", "/F", "/Rect", "/T", "/P", "/V"}) &&
           field.getKey("/Subtype").isNameAndEquals("/Widget") &&
           field.getKey("/FT").isNameAndEquals("/Sig") && IsNothing(field.getKey("/Rect")) &&
           field.getKey("/T").isString() && field.getKey("/T").getUTF8Value() == update_.role &&
           IsSignature(field.getKey("/V"));
  }

  QPDF& before_;
  QPDF& after_;
  const SignedUpdate& update_;
  std::set<int> old_, pages_, growing_;  // numbers of objects
  int field_ = 0;                        // of the role, before; 0 without one
  Object form_;
};

}  // namespace

std::string ForbiddenChange(QPDF& before, QPDF& after, const SignedUpdate& update) {
  return Comparison(before, after, update).Run();
}

}  // namespace telestrain
